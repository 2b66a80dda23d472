// The processes that `mpirun` started together, perhaps on several machines; a single one without mpirun.
#pragma once

#include <optional>
#include <string>

namespace incognita {

/// Joins MPI for its lifetime. Throws InputError if the program was built without MPI but started by mpirun,
/// because every process would then do all the work.
class Ranks {
 public:
  Ranks();
  /// Waits until the other ranks leave, too.
  ~Ranks();  // NOLINT(performance-trivially-destructible): without MPI it could be
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// `kind` is defined by the caller. A long message blocks until it is received.
  void send(int to, int kind, const std::string& text);

  struct Message {
    int from = 0, kind = 0;
    std::string text;
  };
  /// The next message that has arrived, if any.
  std::optional<Message> receive();

 private:
  int rank_ = 0, size_ = 1;
  bool joined_ = false;
};

}  // namespace incognita
