#include "verification/figures/figure.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "emmy/base/check.h"
#include "emmy/io/text_file.h"

namespace emmy::verification {
namespace {

// Colours: Okabe and Ito's palette, distinct also to the colour-blind.
constexpr char kPreamble[] =
    R"(# Draws %1$s.svg from %1$s.csv:  gnuplot %1$s.gp
set terminal svg size %2$d,%3$d dynamic enhanced font 'Arial,15' \
  background rgb 'white'
set output '%1$s.svg'
data = '%1$s.csv'
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
)";

constexpr char kPowersOfTen[] = R"(set logscale xy
set format '10^{%T}'
)";

std::string ShellQuoted(const std::string& text) {
  return absl::StrCat("'", absl::StrReplaceAll(text, {{"'", "'\\''"}}), "'");
}

}  // namespace

std::string FigureCsv(const Figure& figure) {
  EMMY_CHECK(!figure.columns.empty(), figure.name);
  std::string text;
  for (const Column& column : figure.columns) {
    EMMY_CHECK(column.values.size() == figure.columns[0].values.size(),
               figure.name << ": " << column.name);
    absl::StrAppend(&text, text.empty() ? "" : ",", column.name);
  }
  text += '\n';
  for (size_t row = 0; row < figure.columns[0].values.size(); ++row) {
    for (const Column& column : figure.columns) {
      if (&column != &figure.columns[0]) text += ',';
      absl::StrAppendFormat(&text, "%.17g", column.values[row]);
    }
    text += '\n';
  }
  return text;
}

std::string FigureScript(const Figure& figure) {
  return absl::StrFormat(kPreamble, figure.name, figure.width, figure.height) +
         (figure.powers_of_ten ? kPowersOfTen : "") + figure.script;
}

absl::Status WriteFigure(const Figure& figure, const std::string& directory) {
  const std::string path = absl::StrCat(directory, "/", figure.name);
  absl::Status status = WriteTextFile(path + ".csv", FigureCsv(figure));
  if (!status.ok()) return status;
  status = WriteTextFile(path + ".gp", FigureScript(figure));
  if (!status.ok()) return status;
  // An image of an earlier run does not belong to these data.
  std::error_code ignored;
  std::filesystem::remove(path + ".svg", ignored);
  const std::string command =
      absl::StrCat("cd ", ShellQuoted(directory), " && gnuplot ",
                   ShellQuoted(figure.name + ".gp"));
  // Names and directory are quoted; the script is ours. NOLINTNEXTLINE
  if (std::system(command.c_str()) == 0) return absl::OkStatus();
  return absl::UnavailableError(
      absl::StrCat(path,
                   ".svg: not drawn: gnuplot is missing or failed; "
                   "apt-get install gnuplot-nox, then gnuplot ",
                   figure.name, ".gp in that directory"));
}

}  // namespace emmy::verification
