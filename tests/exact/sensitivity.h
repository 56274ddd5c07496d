// How much the motion itself amplifies small relative changes of its data.

#ifndef EMMY_TESTS_EXACT_SENSITIVITY_H_
#define EMMY_TESTS_EXACT_SENSITIVITY_H_

#include "tests/exact/regimes.h"
#include "verification/exact/free_rigid_body.h"

namespace emmy::exact {

// Σ over the data p (moments or tensor entries, ω, time) of
// |x(p + δp) − x(p)|, δp = ± size · |p|, the larger of both signs, x = (R, ω/v)
// at `time`; plus `size` for x itself. A backward stable evaluation with
// relative errors `size` errs by no more. Differences, not derivatives:
// at the separatrix the motion does not depend smoothly on its data.
inline Quad Sensitivity(const FreeRigidBodyStart<Quad>& start, const Quad& time,
                        const Quad& speed, const Quad& size) {
  const auto evaluate = [](const FreeRigidBodyStart<Quad>& s, const Quad& t) {
    return FreeRigidBody<Quad>::Create(s).value().At(t);
  };
  const FreeRigidBodyState<Quad> reference = evaluate(start, time);
  Quad sum = size;
  const auto add = [&](const auto& change) {
    Quad worst = 0;
    for (const Quad& delta : {Quad(size), Quad(-size)}) {
      FreeRigidBodyStart<Quad> changed = start;
      Quad changed_time = time;
      change(delta, &changed, &changed_time);
      const Quad d =
          Distance(evaluate(changed, changed_time), reference, speed);
      worst = std::max(worst, d);
    }
    sum += worst;
  };
  add([](const Quad& d, FreeRigidBodyStart<Quad>*, Quad* t) { *t *= 1 + d; });
  const bool tilted = start.inertia(0, 1) != 0;
  const Quad scale = start.inertia.trace();
  for (int i = 0; i < 3; ++i) {
    add([i](const Quad& d, FreeRigidBodyStart<Quad>* s, Quad*) {
      s->angular_velocity(i) *= 1 + d;
    });
    add([i](const Quad& d, FreeRigidBodyStart<Quad>* s, Quad*) {
      s->inertia(i, i) *= 1 + d;
    });
    if (!tilted) continue;
    add([i, scale](const Quad& d, FreeRigidBodyStart<Quad>* s, Quad*) {
      const int j = (i + 1) % 3;
      s->inertia(i, j) += d * scale;
      s->inertia(j, i) = s->inertia(i, j);
    });
  }
  return sum;
}

}  // namespace emmy::exact

#endif  // EMMY_TESTS_EXACT_SENSITIVITY_H_
