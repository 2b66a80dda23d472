// Independent runs, on all processors, and numbers of each.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <thread>
#include <vector>

namespace incognita {

/// run(seed) for the seeds 1 to `seeds`, in their order whatever the number of processors.
template <class Run>
auto over_seeds(int seeds, const Run& run) {
  std::vector<decltype(run(std::uint64_t{1}))> results(static_cast<std::size_t>(seeds));
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < results.size(); i = next++) results[i] = run(std::uint64_t{i + 1});
  };
  std::vector<std::future<void>> helpers;
  for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k)
    helpers.push_back(std::async(std::launch::async, work));
  work();
  for (std::future<void>& helper : helpers) helper.get();
  return results;
}

/// A number of each result: a member, or what a function makes of it.
template <class Result, class Of>
std::vector<double> each(const std::vector<Result>& results, const Of& of) {
  std::vector<double> numbers;
  for (const Result& r : results) numbers.push_back(std::invoke(of, r));
  return numbers;
}

}  // namespace incognita
