# Draws energy_error.svg from energy_error.csv:  gnuplot energy_error.gp
set terminal svg size 960,500 dynamic enhanced font 'Arial,15' \
  background rgb 'white'
set output 'energy_error.svg'
data = 'energy_error.csv'
set datafile separator ','
set datafile columnheaders
set encoding utf8
set linetype 1 lc rgb '#0072B2' lw 2 pt 7 ps 0.7
set linetype 2 lc rgb '#E69F00' lw 2 pt 5 ps 0.7
set linetype 3 lc rgb '#009E73' lw 2 pt 9 ps 0.8
set linetype 4 lc rgb '#D55E00' lw 2 pt 11 ps 0.8
set linetype 5 lc rgb '#56B4E9' lw 2 pt 13 ps 0.8
set linetype 6 lc rgb '#CC79A7' lw 2 pt 15 ps 0.7
set linetype 7 lc rgb '#000000' lw 2 pt 6 ps 0.8
set grid lc rgb '#DDDDDD' lw 1 lt 1
set tics nomirror
set border 3 lw 1
set logscale xy
set format '10^{%T}'
set lmargin 11
set rmargin 24
set xlabel 'Number of time steps'
set ylabel 'Largest relative energy error'
set xrange [10:*]
set yrange [1e-19:1e-11]
set ytics 100
set key at graph 1.02, 0.98 left top Left reverse samplen 2 spacing 1.15 \
  maxrows 8
array exponent[3] = ['⁸', '¹⁰', '¹²']
array colour[3] = [2, 3, 1]
unit = 1.11e-16
set label 1 'unit round-off' at graph 0.01, first unit * 0.4 \
  font ',13' textcolor rgb '#555555'
plot unit with lines lt 7 lw 1 dt 3 notitle, \
     NaN with lines lc rgb 'white' title 'plain arithmetic', \
     for [k = 3:1:-1] data using 1:(column(2 * k + 1)) with lines \
       lt colour[k] dt 2 title sprintf('α = 10%s Pa', exponent[k]), \
     NaN with lines lc rgb 'white' title 'Emmy', \
     for [k = 3:1:-1] data using 1:(column(2 * k)) with lines lt colour[k] \
       lw 2.5 title sprintf('α = 10%s Pa', exponent[k])
