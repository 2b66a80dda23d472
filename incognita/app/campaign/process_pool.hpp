// Jobs in processes of their own, several at a time: one that crashes takes nothing with it.
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
  std::string answer;  ///< what the job returned; not all of it where it was cut short
  int exit_code = 0;   ///< 0 when the job returned
  int signal = 0;      ///< that ended it; 0: none
  double seconds = 0;
};

/// Processes are forks of this one: starting the program anew takes longer than a short run. They end with
/// it, even when it is killed. Not to be used beside threads of one's own.
class ProcessPool {
 public:
  explicit ProcessPool(std::size_t slots) : slots_(slots) {}
  ~ProcessPool();  ///< ends by force what still runs
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  bool has_room() const { return running_.size() < slots_; }
  bool idle() const { return running_.empty(); }
  std::size_t running() const { return running_.size(); }

  /// `job` is called in the new process, which keeps its standard error alone. What it throws is exit code 1.
  /// Throws std::system_error when there can be no further process.
  void start(std::size_t id, const std::function<std::string()>& job);

  /// Those that ended since; waits at most so long for one, or until a signal comes.
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
