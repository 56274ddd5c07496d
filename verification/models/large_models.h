// Models of any size, to measure cost and conservation on.
//
// All start without load in mid-air, so that energy and both momenta are kept.

#ifndef EMMY_VERIFICATION_MODELS_LARGE_MODELS_H_
#define EMMY_VERIFICATION_MODELS_LARGE_MODELS_H_

#include "emmy/io/case.h"

namespace emmy::verification {

// A spinning square net of n × n nodes (n ≥ 2), 14 m wide, trusses along the
// sides and both diagonals of every mesh (EA = 70 kN), a hub box tied to the
// nodes at the centre, and a mass of 0.1 kg on each corner. Spins about its
// normal with 0.2 rad/s from a saddle 5 cm high. n = 60: 10,800 coordinates,
// 14,042 trusses.
Case SpinningNet(int n);

// The same net of cables, rippling, so that cables go slack and taut.
Case SlackCableNet(int n);

// n boxes of 3 × 2 × 1 m in a row, neighbours sharing the middle of their
// faces (spherical joints), each with an angular velocity of its own.
Case BoxChain(int n);

// The same chain of conventional bodies.
Case ConventionalBoxChain(int n);

// n × n boxes of 3 × 2 × 1 m in a square grid, neighbours sharing the middle of
// their faces: 2 n (n − 1) joints in closed loops. It spins in its plane, and
// each row and column of boxes tilts its own way.
Case BoxGrid(int n);

// n ≥ 3 boxes of 3 × 2 × 1 m along the sides of a regular polygon, neighbours
// sharing its corners: one closed loop of n joints. It spins in its plane and
// ripples out of it, and each box rolls about its side.
Case BoxRing(int n);

// The same loop of conventional bodies.
Case ConventionalBoxRing(int n);

// n boxes in a binary tree of spherical joints: box i hangs on a corner of box
// (i − 1) / 2. They overlap: there is no contact.
Case BoxTree(int n);

// n boxes in a row, 2 m apart, neighbours joined by four trusses, spinning
// about the row.
Case TrussedBoxes(int n);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_MODELS_LARGE_MODELS_H_
