#include "emmy/base/work_team.h"

#include <system_error>
#include <utility>

namespace emmy {

WorkTeam::WorkTeam(size_t size) {
  try {
    for (size_t member = 1; member < size; ++member) {
      others_.emplace_back([this, member] { Serve(member); });
    }
  } catch (const std::system_error&) {
    // Those that there are do the work.
  }
}

WorkTeam::~WorkTeam() {
  ends_ = true;
  ++run_;
  run_.notify_all();
  for (std::thread& thread : others_) thread.join();
}

void WorkTeam::RunMember(size_t member) {
  try {
    call_(target_, member, count_ * member / size(),
          count_ * (member + 1) / size());
  } catch (...) {
    // The work is on the caller's stack, which has to stay until all are done.
    if (!has_failed_.exchange(true)) failure_ = std::current_exception();
  }
}

void WorkTeam::RunCall() {
  if (!others_.empty()) {
    busy_ = others_.size();
    ++run_;
    run_.notify_all();
  }
  RunMember(0);
  for (size_t busy = busy_; busy != 0; busy = busy_) busy_.wait(busy);
  if (has_failed_) {
    has_failed_ = false;
    std::rethrow_exception(std::exchange(failure_, nullptr));
  }
}

void WorkTeam::Serve(size_t member) {
  for (size_t seen = 0;;) {
    run_.wait(seen);
    // One run at a time: the next begins when all have done this one.
    ++seen;
    if (ends_) return;
    RunMember(member);
    if (--busy_ == 0) busy_.notify_all();
  }
}

}  // namespace emmy
