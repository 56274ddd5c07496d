#include "verification/report/group_text.h"

#include <functional>
#include <map>

#include "absl/strings/ascii.h"
#include "absl/strings/str_replace.h"

namespace emmy::verification {

GroupText DescribeGroup(std::string_view group) {
  static const auto& texts = *new std::map<std::string, GroupText, std::less<>>{
      {"conservation",
       {"Conservation",
        "A free body's energy, momentum and angular momentum are constant. The "
        "step keeps them exactly if its equation is solved exactly, so what is "
        "left is round-off, and that is what these claims bound."}},
      {"growth",
       {"Growth of round-off",
        "Unbiased rounding adds up like a random walk, with the square root of "
        "the number of steps; a bias, however small, grows linearly. The "
        "exponent is fitted over many starts."}},
      {"large_steps",
       {"Large steps",
        "The laws hold for any step, not only for small ones; and where an "
        "equation cannot be solved, the step fails with a message instead of "
        "going on wrongly."}},
      {"penalty",
       {"Rigidity by penalty",
        "The stiff penalty makes an affine body rigid. How fast it approaches "
        "the conventional rigid body depends on how an angular velocity is "
        "read off, and on how the body is started."}},
      {"order",
       {"Order of accuracy",
        "Halving the time step divides the error against the exact motion by "
        "two to the power of the order."}},
      {"external",
       {"Agreement with others",
        "Motions that others have published, computed by other methods."}},
      {"structures",
       {"Structures",
        "Bodies joined by trusses, cables and shared points keep the same "
        "laws, and joints do not drift, as constraints are linear in the "
        "coordinates."}},
      {"figures",
       {"Figures",
        "Figures of the paper that the formulation follows, computed anew, and "
        "what they show as numbers."}},
      {"kinematics",
       {"Kinematics and inertia",
        "Every material point is a linear function of the coordinates, so that "
        "the mass matrix is constant; attitude and angular velocity follow "
        "from the polar decomposition."}},
      {"laws",
       {"Equations of motion",
        "Forces are gradients of the energy, the exact motion satisfies the "
        "equations, and what a step leaves unsolved accounts for every change "
        "of energy."}},
      {"symmetry",
       {"Symmetries",
        "Each conserved quantity belongs to a symmetry: the step runs back "
        "the way it came, looks the same to every observer, and does not "
        "depend on the sequence in which things are named."}},
      {"vibration",
       {"Penalty vibration",
        "A stiff body is not rigid: it vibrates with the frequency and "
        "amplitude that linear theory gives, and a relaxed start leaves "
        "hardly any of it."}},
      {"agreement",
       {"Agreement of the two formulations",
        "The same body as an affine body and as a conventional one."}},
      {"composition",
       {"Orders four and six",
        "Steps forth and back, composed, raise the order and keep every law "
        "that one step keeps."}},
      {"angular_velocity",
       {"Angular velocity",
        "Three ways to read an angular velocity off an affine body, over the "
        "whole range of penalties, and what extrapolation gains."}},
      {"baselines",
       {"Comparison with other integrators",
        "The same motion by other methods, each with what it keeps and what "
        "it loses."}},
  };
  const auto found = texts.find(group);
  if (found != texts.end()) return found->second;
  std::string title = absl::StrReplaceAll(
      absl::string_view(group.data(), group.size()), {{"_", " "}});
  if (!title.empty()) {
    title[0] = absl::ascii_toupper(static_cast<unsigned char>(title[0]));
  }
  return {.title = title, .introduction = ""};
}

}  // namespace emmy::verification
