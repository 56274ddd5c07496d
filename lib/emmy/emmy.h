// The library's public interface: everything a program outside it may use.
//
// docs/tutorial.md shows how the parts go together. What these headers declare
// with EMMY_EXPORT is kept from one version to the next within 0.x.*; other
// headers come along because these need them.

#ifndef EMMY_EMMY_H_
#define EMMY_EMMY_H_

// Values and sums.
#include "emmy/base/build_info.h"
#include "emmy/base/compensated_sum.h"
#include "emmy/base/double_double.h"
#include "emmy/base/types.h"
#include "emmy/numerics/polar.h"

// A model: from a description to what can be stepped.
#include "emmy/model/model.h"
#include "emmy/model/model_builder.h"
#include "emmy/model/model_description.h"
#include "emmy/model/state.h"

// Time.
#include "emmy/integrate/body_batch.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/integrate/simulate.h"

// What is observed.
#include "emmy/diagnostics/angular_velocity.h"
#include "emmy/diagnostics/body_motion.h"
#include "emmy/diagnostics/check_state.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/diagnostics/structure_motion.h"
#include "emmy/diagnostics/watched_run.h"

// Files.
#include "emmy/io/case.h"
#include "emmy/io/case_file.h"
#include "emmy/io/case_writer.h"
#include "emmy/io/checkpoint.h"
#include "emmy/io/history.h"
#include "emmy/io/summary.h"

#endif  // EMMY_EMMY_H_
