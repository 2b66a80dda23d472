// The built program as a person or a script meets it: started, watched, asked to end, and looked at
// afterwards.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace incognita::testing {

using Words = std::vector<std::string>;

/// Where a standard stream of the program goes.
enum class Stream { kept, closed, full_disk, nobody };

struct Circumstances {
  std::filesystem::path folder;  ///< works there
  Stream out = Stream::kept, err = Stream::kept;
  rlim_t largest_file = RLIM_INFINITY;
};

struct Ended {
  int code = -1;   ///< -1: a signal ended it
  int signal = 0;  ///< which
  std::string out, err;
};

/// A program that runs. Ended by force when it is dropped, or after two minutes.
class Program {
 public:
  Program(const Words& arguments, const Circumstances& circumstances);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const;
  void signal_group(int number) const;  ///< with its children, as Ctrl-C at a terminal does
  Ended wait();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Closer>;

  File out_, err_;
  pid_t child_ = -1;
};

/// Starts it in a folder and waits for its end.
Ended incognita(const Words& arguments, const std::filesystem::path& folder);
Ended incognita(const Words& arguments, const Circumstances& circumstances);

/// Waits until a file has so many lines. False after half a minute.
bool has_lines(const std::filesystem::path& file, std::size_t count);

/// Everything below a folder, by relative path.
std::set<std::string> everything_in(const std::filesystem::path& folder);

/// Of a run directory. Fails the test where it is no valid JSON or not as docs/schemas says.
nlohmann::json summary_of(const std::filesystem::path& run);

/// Fails the test unless every table of a run directory has whole rows only, as wide as its header, and
/// nothing that is infinite.
void expect_whole_tables(const std::filesystem::path& run);

#define EXPECT_SAYS(text, part) \
  EXPECT_NE(std::string(text).find(part), std::string::npos) << "`" << (text) << "` lacks `" << (part) << "`"
#define EXPECT_SILENT_ON(text, part) \
  EXPECT_EQ(std::string(text).find(part), std::string::npos) << "`" << (text) << "` has `" << (part) << "`"

}  // namespace incognita::testing
