// The messages that wait for a slow viewer are bounded, and the newest win.
#include "incognita/live/outbox.hpp"

#include <gtest/gtest.h>

#include "incognita/live/mailbox.hpp"

namespace incognita {
namespace {

LiveMessage message(const std::string& text, bool droppable = true) {
  LiveMessage out{std::make_shared<const std::string>(text)};
  out.droppable = droppable;
  return out;
}

TEST(Outbox, KeepsTheOrder) {
  Outbox outbox;
  for (const char* text : {"a", "b", "c"}) EXPECT_TRUE(outbox.push(message(text)));
  for (const char* text : {"a", "b", "c"}) EXPECT_EQ(*outbox.pop()->body, text);
  EXPECT_FALSE(outbox.pop());
  EXPECT_EQ(outbox.bytes(), 0u);
}

TEST(Outbox, DropsTheOldestAndCounts) {
  Outbox outbox({3, 1000});
  for (const char* text : {"a", "b", "c", "d", "e"}) EXPECT_TRUE(outbox.push(message(text)));
  EXPECT_EQ(outbox.dropped(), 2u);
  EXPECT_EQ(*outbox.pop()->body, "c");
  outbox.add_dropped(5);
  EXPECT_EQ(outbox.dropped(), 7u);
}

TEST(Outbox, IsBoundedInBytes) {
  Outbox outbox({100, 1000});
  for (int i = 0; i < 50; ++i) outbox.push(message(std::string(300, 'x')));
  EXPECT_LE(outbox.bytes(), 1000u);
  EXPECT_EQ(outbox.messages(), 3u);
  EXPECT_EQ(outbox.dropped(), 47u);
}

TEST(Outbox, TakesOneMessageHoweverLarge) {
  Outbox outbox({100, 1000});
  EXPECT_TRUE(outbox.push(message(std::string(5000, 'x'))));
  EXPECT_EQ(outbox.messages(), 1u);
}

TEST(Outbox, DropsWhatMayBeDroppedOnly) {
  Outbox outbox({3, 1000});
  EXPECT_TRUE(outbox.push(message("state", false)));
  for (const char* text : {"a", "b", "c"}) EXPECT_TRUE(outbox.push(message(text)));
  EXPECT_EQ(*outbox.pop()->body, "state");
  EXPECT_EQ(*outbox.pop()->body, "b");
}

TEST(Outbox, RefusesWhenOnlyImportantMessagesWait) {
  Outbox outbox({2, 1000});
  EXPECT_TRUE(outbox.push(message("a", false)));
  EXPECT_TRUE(outbox.push(message("b", false)));
  EXPECT_FALSE(outbox.push(message("c", false)));
}

TEST(Outbox, ANewStateReplacesTheOneThatWaits) {
  Outbox outbox({2, 1000});
  for (int i = 0; i < 100; ++i) {
    LiveMessage state = message("state " + std::to_string(i), false);
    state.replaces = "state";
    ASSERT_TRUE(outbox.push(state));
  }
  EXPECT_EQ(outbox.messages(), 1u);
  EXPECT_EQ(outbox.bytes(), std::string("state 99").size());
  EXPECT_EQ(outbox.dropped(), 0u);
  EXPECT_EQ(*outbox.pop()->body, "state 99");
}

TEST(Mailbox, DropsTheOldestAndNotifiesOnce) {
  Mailbox<int> mailbox(2);
  EXPECT_TRUE(mailbox.put(1));
  EXPECT_FALSE(mailbox.put(2));
  EXPECT_FALSE(mailbox.put(3));
  const auto taken = mailbox.take();
  EXPECT_EQ(taken.values, (std::deque<int>{2, 3}));
  EXPECT_EQ(taken.dropped, 1u);
  EXPECT_TRUE(mailbox.put(4));
}

}  // namespace
}  // namespace incognita
