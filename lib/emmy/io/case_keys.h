// The keys of the case format, object by object: one table for the reader and
// for the test that holds case.schema.json to it.

#ifndef EMMY_IO_CASE_KEYS_H_
#define EMMY_IO_CASE_KEYS_H_

#include "emmy/io/json_reader.h"

namespace emmy {

inline constexpr ObjectKeys kCaseKeys = {
    "case",
    {"format", "name", "integrator"},
    {"purpose", "gravity", "rigid_bodies", "nodes", "trusses", "springs",
     "shared_points", "loads", "output"}};

inline constexpr ObjectKeys kRigidBodyKeys = {
    "rigid_body",
    {"name"},
    // One of box and inertia; one of the two angular velocities at most.
    {"formulation", "box", "inertia", "penalty", "position", "orientation",
     "velocity", "angular_velocity", "angular_velocity_body", "start"}};
inline constexpr ObjectKeys kBoxKeys = {"box", {"size", "density"}};
inline constexpr ObjectKeys kInertiaKeys = {"inertia",
                                            {"mass", "tensor", "volume"}};
// Exactly one of the two.
inline constexpr ObjectKeys kOrientationKeys = {
    "orientation", {}, {"quaternion", "rotation_vector"}};

inline constexpr ObjectKeys kNodeKeys = {
    "node", {"name", "mass"}, {"position", "velocity", "fixed"}};
inline constexpr ObjectKeys kMovesWithKeys = {"moves_with", {"moves_with"}};

// Of a point that is none of the three kinds; names all keys in messages.
inline constexpr ObjectKeys kPointKeys = {
    "point", {}, {"body", "point", "node", "ground"}};
inline constexpr ObjectKeys kBodyPointKeys = {"body_point", {"body", "point"}};
inline constexpr ObjectKeys kNodePointKeys = {"node_point", {"node"}};
inline constexpr ObjectKeys kGroundPointKeys = {"ground_point", {"ground"}};

inline constexpr ObjectKeys kTrussKeys = {
    "truss",
    {"name", "ends", "area", "density", "young_modulus"},
    {"length", "tension_only"}};
inline constexpr ObjectKeys kSpringKeys = {
    "spring", {"name", "ends", "stiffness", "length"}};

// Of a load that is neither kind.
inline constexpr ObjectKeys kLoadKeys = {
    "load", {}, {"point", "force", "body", "torque"}};
inline constexpr ObjectKeys kForceKeys = {"force_load", {"point", "force"}};
inline constexpr ObjectKeys kTorqueKeys = {"torque_load", {"body", "torque"}};

inline constexpr ObjectKeys kIntegratorKeys = {
    "integrator", {"method", "time_step", "duration"}, {"order", "tolerance"}};
inline constexpr ObjectKeys kOutputKeys = {"output", {}, {"every"}};

}  // namespace emmy

#endif  // EMMY_IO_CASE_KEYS_H_
