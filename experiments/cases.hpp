// A statement tested case by case: what each case gives, and whether it holds in all of them.
#pragma once

#include <initializer_list>
#include <string>

#include "experiments/evidence.hpp"

namespace incognita {

struct CaseResult {
  Text text;
  Answer holds = true;
};

class Cases {
 public:
  void add(const CaseResult& one) {
    if (!text_.empty()) text_ += "; ";
    text_ += one.text.words;
    hold_ = hold_ && one.holds;
  }
  const std::string& text() const { return text_; }  ///< separated by semicolons
  Answer hold() const { return hold_; }

 private:
  std::string text_;
  Answer hold_ = true;
};

/// `1: ...; 2: ...` of each number, e.g. of landmarks: `one(n)` is a CaseResult.
template <class One>
Cases by_number(std::initializer_list<int> numbers, const One& one) {
  Cases all;
  for (const int n : numbers) {
    const CaseResult result = one(n);
    all.add({{"{}: {}", n, result.text.words}, result.holds});
  }
  return all;
}

}  // namespace incognita
