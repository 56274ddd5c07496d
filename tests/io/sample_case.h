// A case that uses every key of the format, as text to vary in tests.

#ifndef EMMY_TESTS_IO_SAMPLE_CASE_H_
#define EMMY_TESTS_IO_SAMPLE_CASE_H_

namespace emmy {

inline constexpr char kSampleCase[] = R"json({
  "format": "emmy-case/1",
  "name": "sample",
  "purpose": "Every key once.",
  "gravity": [0, 0, -9.81],
  "rigid_bodies": [
    {
      "name": "box",
      "formulation": "ancf",
      "box": {"size": [3, 2, 1], "density": 2700},
      "penalty": 1e10,
      "position": [0, 0, 0],
      "orientation": {"quaternion": [1, 0, 0, 0]},
      "velocity": [0, 0, 0],
      "angular_velocity": [0.3, 0.5, 0.8],
      "start": "undeformed"
    },
    {
      "name": "wheel",
      "inertia": {"mass": 2, "tensor": [1, 1, 1.5], "volume": 0.1},
      "penalty": [1e8, 1e8, 1e8, 1e7, 1e7, 1e7],
      "position": [5, 0, 0],
      "orientation": {"rotation_vector": [0.1, 0.2, 0.3]},
      "angular_velocity_body": [0, 0, 2],
      "start": "relaxed"
    },
    {
      "name": "drum",
      "formulation": "conventional",
      "inertia": {
        "mass": 2,
        "tensor": [[1, 0.1, 0], [0.1, 1, 0], [0, 0, 1.5]],
        "volume": 0.1
      },
      "position": [10, 0, 0]
    }
  ],
  "nodes": [
    {
      "name": "tip",
      "mass": 0,
      "position": [1.5, 1.0, 1.3],
      "velocity": {"moves_with": "box"},
      "fixed": false
    },
    {"name": "ball", "mass": 1.5, "position": [0, 5, 0], "velocity": [1, 0, 0]}
  ],
  "trusses": [
    {
      "name": "arm",
      "ends": [{"body": "box", "point": [1.5, 1.0, 0.5]}, {"node": "tip"}],
      "area": 1e-4,
      "density": 2700,
      "young_modulus": 7e10,
      "length": 0.8,
      "tension_only": false
    }
  ],
  "springs": [
    {
      "name": "stay",
      "ends": [{"node": "ball"}, {"ground": [0, 6, 0]}],
      "stiffness": 50,
      "length": 0.5
    }
  ],
  "shared_points": [
    [{"body": "wheel", "point": [0, 0, 0]}, {"ground": [5, 0, 0]}]
  ],
  "loads": [
    {"point": {"node": "ball"}, "force": [0, 0, 1]},
    {"body": "wheel", "torque": [0, 0, 0.1]}
  ],
  "integrator": {
    "method": "energy_momentum",
    "order": 2,
    "time_step": 1e-3,
    "duration": 10,
    "tolerance": "round_off"
  },
  "output": {"every": 10}
})json";

}  // namespace emmy

#endif  // EMMY_TESTS_IO_SAMPLE_CASE_H_
