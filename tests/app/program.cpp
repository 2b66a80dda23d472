#include "tests/app/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>

#include "tests/record/schema.hpp"
#include "tests/scratch.hpp"

namespace incognita::testing {
namespace fs = std::filesystem;
namespace {

constexpr unsigned patience_s = 120;

/// Runs in the child before exec: system calls only.
void connect(int stream, Stream where, std::FILE* kept) {
  int ends[2] = {-1, -1};
  switch (where) {
    case Stream::kept:
      ::dup2(::fileno(kept), stream);
      break;
    case Stream::closed:
      ::close(stream);
      break;
    case Stream::full_disk:
      ::dup2(::open("/dev/full", O_WRONLY), stream);
      break;
    case Stream::no_reader:
      if (::pipe2(ends, O_CLOEXEC) == 0) ::dup2(ends[1], stream);
      break;
  }
}

[[noreturn]] void become_program(const Circumstances& c, std::vector<char*>& argv, std::FILE* out,
                                 std::FILE* err) {
  ::unsetenv("INCOGNITA_DATA");
  ::alarm(patience_s);  // remains active after exec
  if (::chdir(c.folder.c_str()) != 0) ::_exit(126);
  if (c.largest_file != RLIM_INFINITY) {
    const rlimit limited{c.largest_file, c.largest_file};
    ::setrlimit(RLIMIT_FSIZE, &limited);
  }
  connect(STDOUT_FILENO, c.out, out);
  connect(STDERR_FILENO, c.err, err);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

std::string all_of(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file)) text.append(buffer, n);
  return text;
}

/// Number of cells in a row without quotes, as in the tables of a run.
std::size_t cells(const std::string& row, char separator) {
  return 1 + static_cast<std::size_t>(std::count(row.begin(), row.end(), separator));
}

void expect_whole_rows(const fs::path& table, char separator) {
  const std::string text = contents(table);
  EXPECT_TRUE(text.ends_with('\n')) << table;
  EXPECT_EQ(text.find("inf"), std::string::npos) << table;
  if (table.extension() == ".tum") {
    EXPECT_EQ(text.find("nan"), std::string::npos) << table;
  }
  const std::vector<std::string> rows = lines(table);
  ASSERT_FALSE(rows.empty()) << table;
  const std::size_t requested = separator == ' ' ? 8 : cells(rows.front(), separator);
  for (std::size_t i = 1; i < rows.size(); ++i)
    ASSERT_EQ(cells(rows[i], separator), requested) << table << rows[i];
}

}  // namespace

Program::Program(const Words& arguments, const Circumstances& circumstances)
    : out_(std::tmpfile()), err_(std::tmpfile()) {
  Words words = {INCOGNITA_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  child_ = ::fork();
  // a process group, as a shell makes it: signals of the terminal go to the group
  if (child_ == 0) ::setpgid(0, 0);
  if (child_ == 0) become_program(circumstances, argv, out_.get(), err_.get());
  if (child_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
}

Program::~Program() {
  if (child_ < 0) return;
  signal(SIGKILL);
  wait();
}

void Program::signal(int number) const { ::kill(child_, number); }
void Program::signal_group(int number) const { ::kill(-child_, number); }

Ended Program::wait() {
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  Ended ended;
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
  ended.out = all_of(out_.get());
  ended.err = all_of(err_.get());
  return ended;
}

Ended incognita(const Words& arguments, const fs::path& folder) {
  Circumstances circumstances;
  circumstances.folder = folder;
  return incognita(arguments, circumstances);
}

Ended incognita(const Words& arguments, const Circumstances& circumstances) {
  return Program(arguments, circumstances).wait();
}

std::vector<Eigen::Vector3d> positions(const fs::path& tum) {
  std::vector<Eigen::Vector3d> out;
  for (const std::string& line : lines(tum)) {
    std::istringstream numbers(line);
    double t = 0;
    Eigen::Vector3d p;
    if (numbers >> t >> p.x() >> p.y() >> p.z()) out.push_back(p);
  }
  return out;
}

bool has_lines(const fs::path& file, std::size_t count) {
  for (int i = 0; i < 3000; ++i) {
    if (lines(file).size() >= count) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

std::set<std::string> everything_in(const fs::path& folder) {
  std::set<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    found.insert(fs::relative(entry.path(), folder).string());
  return found;
}

nlohmann::json summary_of(const fs::path& run) {
  const auto schema =
      nlohmann::json::parse(contents(fs::path(INCOGNITA_SOURCE_DIR) / "docs/schemas/summary.schema.json"));
  auto summary = nlohmann::json::parse(contents(run / "summary.json"), nullptr, false);
  EXPECT_TRUE(summary.is_object()) << contents(run / "summary.json");
  if (summary.is_object()) {
    EXPECT_EQ(problems(summary, schema), "");
  }
  return summary;
}

void expect_whole_tables(const fs::path& run) {
  for (const char* name :
       {"series.csv", "measurements.csv", "actions.csv", "covariance.csv", "timings.csv", "map.csv"}) {
    if (fs::exists(run / name)) expect_whole_rows(run / name, ',');
  }
  for (const char* name : {"estimate.tum", "truth.tum"}) {
    if (fs::exists(run / name)) expect_whole_rows(run / name, ' ');
  }
}

}  // namespace incognita::testing
