// Threads that share out the same work again and again.
//
// They sleep between two runs; a run allocates nothing.

#ifndef EMMY_BASE_WORK_TEAM_H_
#define EMMY_BASE_WORK_TEAM_H_

#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace emmy {

class WorkTeam {
 public:
  // `size` threads, at least one: the caller's, and others; fewer where the
  // system gives no more.
  explicit WorkTeam(size_t size);
  ~WorkTeam();
  WorkTeam(const WorkTeam&) = delete;
  WorkTeam& operator=(const WorkTeam&) = delete;

  size_t size() const { return others_.size() + 1; }

  // Calls work(member, first, last) once a member, the ranges of which are
  // [0, count) together, and returns when all are done. What one of them
  // throws (an allocation may fail) is thrown on then; the first, if several.
  template <typename Work>
  void Run(size_t count, const Work& work) {
    call_ = [](const void* target, size_t member, size_t first, size_t last) {
      (*static_cast<const Work*>(target))(member, first, last);
    };
    target_ = &work;
    count_ = count;
    RunCall();
  }

 private:
  void RunCall();
  void RunMember(size_t member);
  void Serve(size_t member);

  void (*call_)(const void* target, size_t member, size_t first,
                size_t last) = nullptr;
  const void* target_ = nullptr;
  size_t count_ = 0;
  std::atomic<size_t> run_ = 0;  // Changes when there is work, or an end.
  std::atomic<size_t> busy_ = 0;
  bool ends_ = false;
  std::atomic<bool> has_failed_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> others_;
};

}  // namespace emmy

#endif  // EMMY_BASE_WORK_TEAM_H_
