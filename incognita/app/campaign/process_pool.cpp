#include "incognita/app/campaign/process_pool.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

namespace incognita {
namespace {

[[noreturn]] void carry_out(const std::function<std::string()>& job, int answer, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);                                   // the parent has already died
  for (const int signal : {SIGINT, SIGHUP}) std::signal(signal, SIG_IGN);  // left to the parent
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGPIPE, SIG_IGN);
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  std::string text;
  try {
    text = job();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "incognita: %s\n", error.what());
    ::_exit(1);
  }
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(answer, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    done += static_cast<std::size_t>(n);
  }
  ::_exit(0);  // skips the parent's exit handlers
}

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// Appends available data. False at the end.
bool read_some(int descriptor, std::string& text) {
  char buffer[16384];
  const ssize_t n = ::read(descriptor, buffer, sizeof buffer);
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  text.append(buffer, static_cast<std::size_t>(n));
  return n > 0;
}

}  // namespace

ProcessPool::~ProcessPool() {
  for (const Running& r : running_) ::kill(r.process, SIGKILL);
  for (const Running& r : running_) {
    ::close(r.answer);
    wait_for(r.process);
  }
}

void ProcessPool::start(std::size_t id, const std::function<std::string()>& job) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::fflush(stdout);
  std::fflush(stderr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    carry_out(job, ends[1], parent);
  }
  const int error = errno;
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw std::system_error(error, std::generic_category(), "fork");
  }
  running_.push_back({id, child, ends[0], {}, std::chrono::steady_clock::now()});
}

std::vector<JobEnd> ProcessPool::wait(std::chrono::milliseconds at_most) {
  std::vector<JobEnd> ended;
  std::vector<pollfd> watched;
  for (const Running& r : running_) watched.push_back({r.answer, POLLIN, 0});
  if (::poll(watched.data(), watched.size(), static_cast<int>(at_most.count())) <= 0) return ended;
  for (std::size_t i = watched.size(); i-- > 0;) {
    Running& r = running_[i];
    if (watched[i].revents == 0 || read_some(r.answer, r.text)) continue;
    ::close(r.answer);
    const int status = wait_for(r.process);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - r.since;
    ended.push_back({r.id, std::move(r.text), WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                     WIFSIGNALED(status) ? WTERMSIG(status) : 0, took.count()});
    running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return ended;
}

}  // namespace incognita
