// Runs several jobs at a time, each in a process of its own, so that a crash affects that job only.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace incognita {

/// How a job ended.
struct JobEnd {
  std::size_t id = 0;
  std::string answer;  ///< return value of the job; incomplete if it was killed
  int exit_code = 0;   ///< 0 if the job returned
  int signal = 0;      ///< the signal that killed it; 0: none
  double seconds = 0;
};

/// Processes are forks of this one, because starting the program anew takes longer than a short run. They end
/// with it, even if it is killed. Must not be used in a program with other threads.
class ProcessPool {
 public:
  explicit ProcessPool(std::size_t slots) : slots_(slots) {}
  ~ProcessPool();  ///< kills the remaining processes
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  bool has_room() const { return running_.size() < slots_; }
  bool idle() const { return running_.empty(); }
  std::size_t running() const { return running_.size(); }

  /// Calls `job` in the new process, with standard input and output on /dev/null. An exception of the job
  /// gives exit code 1. Throws std::system_error if no process can be started.
  void start(std::size_t id, const std::function<std::string()>& job);

  /// Jobs that ended since the last call; waits up to `at_most` for one, or until a signal arrives.
  std::vector<JobEnd> wait(std::chrono::milliseconds at_most);

 private:
  struct Running {
    std::size_t id = 0;
    pid_t process = -1;
    int answer = -1;  ///< reading end of a pipe
    std::string text = {};
    std::chrono::steady_clock::time_point since = {};
  };

  std::size_t slots_;
  std::vector<Running> running_;
};

}  // namespace incognita
