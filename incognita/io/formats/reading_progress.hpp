// How far a reading that takes long has come: an index of a bag, the times of a video.
//
// Such files are read far below those who could show progress (a camera that a scenario takes from its bag), so that no parameter leads
// there: a listener hears what its own thread reads while it lives.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace incognita {

class ReadingListener {
 public:
  struct Reading {
    std::filesystem::path file;
    std::string unit;         ///< "bytes", "messages", "images"
    std::uint64_t total = 0;  ///< as the file announces it; 0: it does not
  };

  ReadingListener() : outer_(std::exchange(innermost(), this)) {}
  virtual ~ReadingListener() { innermost() = outer_; }
  ReadingListener(const ReadingListener&) = delete;
  ReadingListener& operator=(const ReadingListener&) = delete;

  /// Called often. `done` increases.
  virtual void progressed(const Reading& reading, std::uint64_t done) = 0;
  /// Whole, or ended by an exception.
  virtual void ended(const Reading& reading) = 0;

  /// The innermost listener of this thread; null without one.
  static ReadingListener* of_thread() { return innermost(); }

 private:
  static ReadingListener*& innermost() {
    static thread_local ReadingListener* listener = nullptr;
    return listener;
  }

  ReadingListener* outer_;
};

/// For readers: reports to the listener of this thread, if there is one.
class ReportedReading {
 public:
  ReportedReading(std::filesystem::path file, std::string unit, std::uint64_t total)
      : reading_{std::move(file), std::move(unit), total} {}
  ~ReportedReading() {
    if (ReadingListener* listener = ReadingListener::of_thread(); listener && done_ > 0)
      listener->ended(reading_);
  }
  ReportedReading(const ReportedReading&) = delete;
  ReportedReading& operator=(const ReportedReading&) = delete;

  void done(std::uint64_t units) {
    if (units <= done_) return;
    done_ = units;
    if (ReadingListener* listener = ReadingListener::of_thread()) listener->progressed(reading_, done_);
  }

 private:
  ReadingListener::Reading reading_;
  std::uint64_t done_ = 0;
};

}  // namespace incognita
