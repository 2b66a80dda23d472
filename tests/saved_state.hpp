// Saves one object and restores another from that.
#pragma once

#include <gtest/gtest.h>

#include "incognita/math/saved_state/state_archive.hpp"

namespace incognita::testing {

/// Puts what `saved` saves into `restored`; all of it must be read.
template <class T>
void restore(T& restored, T& saved) {
  StateWriter writer;
  StateArchive to(writer);
  saved.state(to);
  StateReader reader(writer.bytes());
  StateArchive from(reader);
  restored.state(from);
  EXPECT_EQ(reader.left(), 0u);
}

}  // namespace incognita::testing
