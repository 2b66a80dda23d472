#include "incognita/record/files/row_file.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <limits>

#include "file_size_limit.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/number.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::lines;
using testing::Scratch;

TEST(RowFile, IsFlushedAfterASecond) {
  const Scratch scratch;
  RowFile file(scratch / "rows.csv", "t,x");
  EXPECT_EQ(contents(scratch / "rows.csv"), "t,x\n");
  file.append("10,1", 10);
  file.append("10.5,2", 10.5);
  file.append("11,3", 11);
  EXPECT_EQ(contents(scratch / "rows.csv"), "t,x\n10,1\n10.5,2\n11,3\n");
  file.append("11.5,4", 11.5);
  file.close();
  EXPECT_EQ(lines(scratch / "rows.csv").back(), "11.5,4");
}

TEST(RowFile, IsFlushedEarlierWhenThereIsMuchData) {
  const Scratch scratch;
  RowFile file(scratch / "rows.csv", "");
  for (int i = 0; i < 10000; ++i) file.append("0123456789012345678901234567890123456789", 1);
  EXPECT_GT(contents(scratch / "rows.csv").size(), 300000u);
}

TEST(RowFile, KeepsCompleteRowsWhenTheDiskIsFull) {
  for (const int bytes : {17, 1000, 1003, 4096}) {
    const Scratch scratch;
    const testing::FileSizeLimit limit(bytes);
    RowFile file(scratch / "rows.csv", "t,x");
    std::string reason;
    try {
      for (int i = 0; i < 5000; ++i) file.append("0.123,4.56", 0.1 * i);
    } catch (const RecordError& error) {
      reason = error.what();
    }
    EXPECT_NE(reason.find("rows.csv"), std::string::npos) << reason;
    EXPECT_NO_THROW(file.append("more", 1e6));  // the failure was reported once
    EXPECT_NO_THROW(file.close());
    const std::string text = contents(scratch / "rows.csv");
    EXPECT_EQ(text.size(), 4 + 11 * ((bytes - 4) / 11)) << "as many whole rows as fit";
    for (const std::string& line : lines(scratch / "rows.csv"))
      EXPECT_TRUE(line == "t,x" || line == "0.123,4.56") << line;
    EXPECT_EQ(text.back(), '\n');
  }
}

TEST(RowFile, NamesTheFileThatItCannotOpen) {
  try {
    RowFile("/nowhere/at/all.csv", "t");
    FAIL();
  } catch (const RecordError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.csv"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("--out"), std::string::npos);
  }
}

TEST(WholeFile, IsWrittenWholeOrNotAtAll) {
  const Scratch scratch;
  const testing::FileSizeLimit limit(1000);
  write_whole_file(scratch / "small", std::string(1000, 'x'));
  EXPECT_EQ(contents(scratch / "small").size(), 1000u);
  EXPECT_THROW(write_whole_file(scratch / "large", std::string(1001, 'x')), RecordError);
  EXPECT_FALSE(std::filesystem::exists(scratch / "large"));
}

TEST(Number, RoundTripsExactly) {
  for (const double value : {0.1, -1.0 / 3, 1e300, 5e-324, 1403636579.7635555, 0.0, -7.0}) {
    std::string text;
    append_number(text, value);
    EXPECT_EQ(*parse_number(text), value) << text;
  }
  std::string text;
  append_number(text, 0.1);
  append_cell(text, -std::numeric_limits<double>::quiet_NaN());
  append_cell(text, "a,b \"c\"");
  EXPECT_EQ(text, "0.1,nan,\"a,b \"\"c\"\"\"");
}

TEST(Number, RefusesTrailingCharacters) {
  EXPECT_EQ(parse_number(" +1.5\r"), 1.5);
  for (const char* word : {"", " ", "1.5x", "x", "1,5", "+-1", "0x10", "--1"})
    EXPECT_FALSE(parse_number(word)) << word;
}

}  // namespace
}  // namespace incognita
