// CDR and ROS 1 serialization, byte by byte.
#include "incognita/io/bags/message_cursor.hpp"

#include <gtest/gtest.h>

#include "incognita/io/bags/messages.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using namespace std::string_literals;
using bags::MessageCursor;
using bags::MessageError;
using bags::Serialization;
using testing::message_of;

/// A transform at 1 s and 2 ns of "b" in "a", position (1, 0, 0), no rotation: DDS-XTypes 1.3, 7.4.3, by hand.
std::string transform_in_cdr(bool big_endian) {
  const auto word = [&](char c) { return big_endian ? "\0\0\0"s + c : c + "\0\0\0"s; };
  const auto number = [&](const std::string& high) {
    return big_endian ? high + std::string(6, '\0') : std::string(6, '\0') + high[1] + high[0];
  };
  const std::string one = number("\x3F\xF0"), zero(8, '\0');
  return "\0"s + (big_endian ? "\0"s : "\1"s) + "\0\0"s +  // encapsulation
         word(1) + word(2) +                               // stamp
         word(2) + "a\0"s + "\0\0"s +                      // text with its zero, then padding to 4
         word(2) + "b\0"s + "\0\0"s +                      // then 24 bytes: no padding to 8
         one + zero + zero + zero + zero + zero + one;
}

void expect_transform(const std::string& bytes, Serialization serialization) {
  MessageCursor cursor(bytes, serialization);
  const bags::PoseMessage pose = bags::read_transform(cursor);
  EXPECT_EQ(pose.header.stamp_ns, 1'000'000'002);
  EXPECT_EQ(pose.header.frame, "a");
  EXPECT_EQ(pose.child, "b");
  EXPECT_EQ(pose.position, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(pose.rotation, Eigen::Vector4d(1, 0, 0, 0));
}

TEST(MessageCursor, ReadsCdrOfBothByteOrders) {
  expect_transform(transform_in_cdr(false), Serialization::cdr);
  expect_transform(transform_in_cdr(true), Serialization::cdr);
}

TEST(MessageCursor, ReadsRos1WithTheNumberOfItsHeader) {
  const std::string one = "\0\0\0\0\0\0\xF0\x3F"s, zero(8, '\0');
  expect_transform("\x09\0\0\0"s + "\1\0\0\0"s + "\2\0\0\0"s + "\2\0\0\0/a"s + "\1\0\0\0b"s + one + zero +
                       zero + zero + zero + zero + one,
                   Serialization::ros1);
}

TEST(MessageCursor, AlignsNumbersFromTheEndOfTheEncapsulation) {
  const std::string bytes = "\0\1\0\0"s + "\7"s + std::string(7, '\x55') + "\0\0\0\0\0\0\xF0\x3F"s + "\1\0"s +
                            "\x55\x55"s + "\2\0\0\0"s;
  MessageCursor cursor(bytes, Serialization::cdr);
  EXPECT_EQ(cursor.number<std::uint8_t>(), 7);
  EXPECT_EQ(cursor.number<double>(), 1);
  EXPECT_EQ(cursor.number<std::uint16_t>(), 1);
  EXPECT_EQ(cursor.number<std::uint32_t>(), 2u);
}

TEST(MessageCursor, RefusesMessagesThatAreCutOff) {
  const std::string whole = transform_in_cdr(false);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string cut = whole.substr(0, size);
    EXPECT_THROW(
        {
          MessageCursor cursor(cut, Serialization::cdr);
          bags::read_transform(cursor);
        },
        MessageError)
        << size;
  }
}

TEST(MessageCursor, RefusesListsThatAreLongerThanTheMessage) {
  const std::string bytes = "\0\1\0\0\xFF\xFF\xFF\xFF"s;
  EXPECT_HAS(message_of<MessageError>([&] {
               MessageCursor cursor(bytes, Serialization::cdr);
               bags::read_transforms(cursor);
             }),
             "byte 8: a list of 4294967295 entries is longer than the message");
}

TEST(MessageCursor, RefusesOtherEncapsulations) {
  EXPECT_HAS(message_of<MessageError>([] { MessageCursor cursor("\0\7\0\0"s, Serialization::cdr); }),
             "begins with 00 07, which is not plain CDR");
}

}  // namespace
}  // namespace incognita
