// Runs the built program as a user or a script would: starts it, waits for it, interrupts it, and inspects
// its output.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <Eigen/Core>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace incognita::testing {

using Words = std::vector<std::string>;

/// Target of a standard stream of the program.
enum class Stream { kept, closed, full_disk, no_reader };

struct Circumstances {
  std::filesystem::path folder;  ///< its working directory
  Stream out = Stream::kept, err = Stream::kept;
  rlim_t largest_file = RLIM_INFINITY;
};

struct Ended {
  int code = -1;   ///< -1: ended by a signal
  int signal = 0;  ///< number of that signal
  std::string out, err;
};

/// A running program. Killed by the destructor, or after two minutes.
class Program {
 public:
  Program(const Words& arguments, const Circumstances& circumstances);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const;
  void signal_group(int number) const;  ///< signals its children too, as Ctrl-C in a terminal does
  Ended wait();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Closer>;

  File out_, err_;
  pid_t child_ = -1;
};

/// Runs it in a folder until it ends.
Ended incognita(const Words& arguments, const std::filesystem::path& folder);
Ended incognita(const Words& arguments, const Circumstances& circumstances);

/// Waits until a file has that many lines. False after half a minute.
bool has_lines(const std::filesystem::path& file, std::size_t count);

/// All files below a folder, by relative path.
std::set<std::string> everything_in(const std::filesystem::path& folder);

/// x, y, z of each row of a file of poses, m.
std::vector<Eigen::Vector3d> positions(const std::filesystem::path& tum);

/// The summary of a run directory. Fails the test if it is not valid JSON or violates its schema in
/// docs/schemas.
nlohmann::json summary_of(const std::filesystem::path& run);

/// Fails the test unless every row of every table of a run directory is complete, as wide as its header, and
/// finite.
void expect_whole_tables(const std::filesystem::path& run);

#define EXPECT_SAYS(text, part) \
  EXPECT_NE(std::string(text).find(part), std::string::npos) << "`" << (text) << "` lacks `" << (part) << "`"
#define EXPECT_SILENT_ON(text, part) \
  EXPECT_EQ(std::string(text).find(part), std::string::npos) << "`" << (text) << "` has `" << (part) << "`"

}  // namespace incognita::testing
