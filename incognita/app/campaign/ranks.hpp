// The processes that `mpirun` started together, perhaps on many machines. Without it there is one.
#pragma once

#include <optional>
#include <string>

namespace incognita {

/// Joins them while it lives. Where the program was built without MPI and mpirun started it all the same, the
/// constructor throws InputError: every process would do all the work.
class Ranks {
 public:
  Ranks();
  /// Waits for the others to leave too.
  ~Ranks();  // NOLINT(performance-trivially-destructible): without MPI it could be
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Kinds are the caller's. Waits until the other has it when it is long.
  void send(int to, int kind, const std::string& text);

  struct Message {
    int from = 0, kind = 0;
    std::string text;
  };
  /// The next one that has arrived, if any.
  std::optional<Message> receive();

 private:
  int rank_ = 0, size_ = 1;
  bool joined_ = false;
};

}  // namespace incognita
