// SPDX-License-Identifier: Apache-2.0
// The server against good and bad clients: whatever one of them does, it ends at most its own
// connection.
#include "hal/console/server.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "hal/console/assets.h"
#include "hal/console/limits.h"
#include "served.h"

namespace stylet::console::test {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kManyRows = kMaxRowsPerAnswer;

// The console still does what it is for.
void expect_alive(Served& served) {
  Client client(served.port);
  ASSERT_EQ(client.join(), 101U);
  EXPECT_NE(client.next_of<Hello>(Body::Hello), nullptr);
}

TEST(Server, ServesThePageTheOrganAndTheCounters) {
  Served served;
  std::string body;
  Client client(served.port);  // one connection for all of them
  client.get("/");
  EXPECT_EQ(client.answer(&body), 200U);
  EXPECT_EQ(body, page_html());
  client.get("/app.js");
  EXPECT_EQ(client.answer(&body), 200U);
  EXPECT_EQ(body, page_script());
  client.get("/app.css");
  EXPECT_EQ(client.answer(&body), 200U);
  EXPECT_EQ(body, page_style());
  client.get("/organ");
  EXPECT_EQ(client.answer(&body), 200U);
  ASSERT_EQ(body.size(), served.bytes.size());
  EXPECT_EQ(std::memcmp(body.data(), served.bytes.data(), body.size()), 0);
  client.get("/metrics");
  EXPECT_EQ(client.answer(&body), 200U);
  EXPECT_EQ(body, "lost_frames 0\n");
  client.get("/app.js.map");
  EXPECT_EQ(client.answer(), 404U);
}

TEST(Server, TellsAnAttemptRowByRow) {
  Served served;
  Client client(served.port);
  ASSERT_EQ(client.join(), 101U);
  const Hello* hello = client.next_of<Hello>(Body::Hello);
  ASSERT_NE(hello, nullptr);
  EXPECT_EQ(hello->protocol(), kProtocol);
  EXPECT_TRUE(hello->may_control());
  EXPECT_EQ(hello->particles(), 125U);
  EXPECT_EQ(hello->rest_m()->size(), 125U);
  EXPECT_EQ(hello->corners()->size(), 512U);
  served.server->show(Activity::Running);
  served.run_all();
  const std::uint64_t last = served.config.ticks;
  std::size_t events = 0;
  float deepest_m = 0;
  std::uint64_t row_tick = 0;
  while (row_tick < last) {
    const Frame* frame = client.next_of<Frame>(Body::Frame);
    ASSERT_NE(frame, nullptr);
    events += frame->events()->size();
    for (const Row* row : *frame->rows()) {
      EXPECT_GE(row->tick(), row_tick);
      row_tick = row->tick();
      deepest_m = std::max(deepest_m, row->depth_m());
    }
    ASSERT_EQ(frame->needles()->size(), 1U);
    EXPECT_LE(frame->tick(), last);
  }
  EXPECT_GT(deepest_m, 0.01F);
  EXPECT_GT(events, 1U);
}

TEST(Server, AnswersForRowsAndScores) {
  Served served;
  served.run_all();
  served.server->show(ScoredAttempt{1, "A. Trainee", "2026-11-21T15:00:00+0000", "out-1.h5", {}});
  Client client(served.port);
  ASSERT_EQ(client.join(), 101U);
  const Score* score = client.next_of<Score>(Body::Score);
  ASSERT_NE(score, nullptr);
  EXPECT_EQ(score->trainee()->str(), "A. Trainee");
  EXPECT_EQ(score->recording()->str(), "out-1.h5");
  EXPECT_GT(score->rows()->size(), 100U);
  client.say_message(
      page_message(Body::AskRows, [](auto& b) { return CreateAskRows(b, 50, 149, 20); }));
  const Rows* rows = client.next_of<Rows>(Body::Rows);
  ASSERT_NE(rows, nullptr);
  EXPECT_EQ(rows->first(), 50U);
  EXPECT_EQ(rows->stride(), 10U);
  EXPECT_GE(rows->rows()->size(), 10U);
  EXPECT_LE(rows->rows()->size(), 20U);
  EXPECT_EQ(rows->rows()->Get(0)->tick(), 50U);
}

TEST(Server, TheFirstPageIsInControlUntilItLeaves) {
  Served served;
  auto first = std::make_unique<Client>(served.port);
  ASSERT_EQ(first->join(), 101U);
  ASSERT_NE(first->next_of<Hello>(Body::Hello), nullptr);
  Client second(served.port);
  ASSERT_EQ(second.join(), 101U);
  const Hello* hello = second.next_of<Hello>(Body::Hello);
  ASSERT_NE(hello, nullptr);
  EXPECT_FALSE(hello->may_control());
  const auto start =
      page_message(Body::Start, [](auto& b) { return CreateStart(b, b.CreateString("Second")); });
  second.say_message(start);
  EXPECT_NE(second.next_of<Refused>(Body::Refused), nullptr);
  EXPECT_EQ(served.orders_taken(), 0U);
  first.reset();
  hello = second.next_of<Hello>(Body::Hello);
  ASSERT_NE(hello, nullptr);
  EXPECT_TRUE(hello->may_control());
  second.say_message(start);
  // The page is also told what the session refuses; by then the session has taken the order before
  // it.
  second.say_message(page_message(Body::Reset, [](auto& b) { return CreateReset(b); }));
  const Refused* refused = second.next_of<Refused>(Body::Refused);
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->what()->str(), "not now");
  EXPECT_EQ(served.orders_taken(), 2U);
  EXPECT_EQ(served.orders[0].text, "Second");
}

TEST(Server, TheTokenIsAskedFor) {
  GateConfig gate;
  gate.token = new_token();
  Served served(gate);
  Client wrong(served.port);
  EXPECT_EQ(wrong.join("/ws?token=" + new_token()), 401U);
  Client right(served.port);
  EXPECT_EQ(right.join("/ws?token=" + gate.token), 101U);
  Client page(served.port);
  page.get("/");
  EXPECT_EQ(page.answer(), 200U);
  page.get("/organ");
  EXPECT_EQ(page.answer(), 401U);
}

TEST(Server, AnotherSitesPageIsNotLetIn) {
  Served served;
  Client origin(served.port);
  EXPECT_EQ(origin.join("/ws", "Origin: http://evil.example\r\n"), 403U);
  Client rebound(served.port);
  rebound.say("GET /organ HTTP/1.1\r\nHost: evil.example:" + std::to_string(served.port) +
              "\r\n\r\n");
  EXPECT_EQ(rebound.answer(), 403U);
  Client own(served.port);
  EXPECT_EQ(own.join("/ws", "Origin: http://127.0.0.1:" + std::to_string(served.port) + "\r\n"),
            101U);
}

TEST(Server, MalformedRequestsCloseTheirConnection) {
  Served served;
  const std::string host = "Host: 127.0.0.1:" + std::to_string(served.port) + "\r\n";
  for (const std::string& bad :
       {std::string("\0\xff\xfe\x01 nonsense\r\n\r\n", 18), std::string("GET\r\n\r\n"),
        std::string("GET / HTTP/9.9\r\n\r\n"),
        "GET / HTTP/1.1\r\n" + host + "X: " + std::string(100'000, 'x') + "\r\n\r\n",
        "GET /" + std::string(100'000, 'a') + " HTTP/1.1\r\n" + host + "\r\n",
        "POST / HTTP/1.1\r\n" + host + "Content-Length: 1000000000\r\n\r\nxxxx",
        "POST / HTTP/1.1\r\n" + host +
            "Transfer-Encoding: chunked\r\n\r\nFFFFFFFFFFFFFFFFFF\r\n"}) {
    Client client(served.port);
    client.say(bad);
    EXPECT_TRUE(client.closed()) << bad.substr(0, 40);
  }
  expect_alive(served);
}

TEST(Server, ForeignFramesCloseTheirConnection) {
  Served served;
  const auto good = page_message(Body::Pause, [](auto& b) { return CreatePause(b); });
  const std::string_view bytes = {reinterpret_cast<const char*>(good.data()), good.size()};
  struct Case {
    const char* name;
    std::string payload;
    unsigned opcode;
    bool masked;
  };
  const Case cases[] = {
      {"huge", std::string(kMaxMessageBytes + 1, 'x'), 2, true},
      {"unmasked", std::string(bytes), 2, false},
      {"text", std::string(bytes), 1, true},
      {"reserved opcode", std::string(bytes), 5, true},
      {"continuation of nothing", std::string(bytes), 0, true},
      {"no message", "STLC", 2, true},
      {"empty", "", 2, true},
      {"one of the server's", "", 2, true},
  };
  for (const Case& each : cases) {
    Client client(served.port);
    ASSERT_EQ(client.join(), 101U);
    client.say_frame(each.payload, each.opcode, each.masked);
    EXPECT_TRUE(client.closed()) << each.name;
  }
  Client endless(served.port);
  ASSERT_EQ(endless.join(), 101U);
  endless.say(std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14));  // 2^63 bytes
  EXPECT_TRUE(endless.closed());
  expect_alive(served);
  EXPECT_EQ(served.orders_taken(), 0U);
}

TEST(Server, MutatedMessagesAreReadOrCloseTheirConnection) {
  Served served;
  std::mt19937 random(7);
  const auto good = page_message(
      Body::Start, [](auto& b) { return CreateStart(b, b.CreateString("A. Trainee")); });
  for (int i = 0; i < 200; ++i) {
    std::string bytes(reinterpret_cast<const char*>(good.data()), good.size());
    for (int flip = 0; flip < 3; ++flip)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    Client client(served.port);
    ASSERT_EQ(client.join(), 101U);
    client.say_frame(bytes);
  }
  expect_alive(served);
}

TEST(Server, TooManyMessagesCloseTheirConnection) {
  Served served;
  Client client(served.port);
  ASSERT_EQ(client.join(), 101U);
  const auto pause = page_message(Body::Pause, [](auto& b) { return CreatePause(b); });
  bool open = true;
  for (std::uint32_t i = 0; open && i < 50 * kMaxMessagesPerSecond; ++i) {
    open = client.say_message(pause);
  }
  EXPECT_TRUE(!open || client.closed());
  expect_alive(served);
}

TEST(Server, ASlowRequestIsClosedInTime) {
  Served served;
  Client slow(served.port);
  const auto start = std::chrono::steady_clock::now();
  const std::string request = "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: y";
  bool open = true;
  for (std::size_t i = 0; open && i < request.size(); ++i) {
    open = slow.say(request.substr(i, 1)) && !slow.closed(500ms);
  }
  EXPECT_FALSE(open);
  EXPECT_LT(std::chrono::steady_clock::now() - start, kRequestTime + 10s);
  expect_alive(served);
}

TEST(Server, MoreConnectionsThanSeatsAreClosed) {
  Served served;
  std::vector<std::unique_ptr<Client>> clients;
  for (std::size_t i = 0; i < kMaxConnections; ++i) {
    clients.push_back(std::make_unique<Client>(served.port));
    ASSERT_EQ(clients.back()->join(), 101U);
  }
  Client one_more(served.port);
  one_more.get("/");
  EXPECT_TRUE(one_more.closed());
  clients.clear();
  std::this_thread::sleep_for(200ms);
  expect_alive(served);
}

auto all_rows() {
  return page_message(Body::AskRows,
                      [](auto& b) { return CreateAskRows(b, 1, kManyRows, kMaxRowsPerAnswer); });
}

// So many that an answer with all of them has more than a megabyte.
void tell_many_rows(Served& served) {
  hal::TickRecord record = {};
  while (record.output.tick < kManyRows) {
    ++record.output.tick;
    while (!served.server->tell({false, row_of(record, served.course), {}})) {
      std::this_thread::sleep_for(1ms);
    }
  }
  std::this_thread::sleep_for(3 * kFramePause);
}

void publish(Served& served, int states) {
  hal::TickRecord record = {};
  for (int i = 0; i < states; ++i) {
    ++record.output.tick;
    served.display->publish(served.instance->kernel, std::span(&record, 1), 0, 0);
    std::this_thread::sleep_for(2 * kFramePause);
  }
}

TEST(Server, FramesThatAPageWasTooSlowForAreCounted) {
  Served served;
  tell_many_rows(served);
  publish(served, 1);
  Client slow(served.port, 65536);
  ASSERT_EQ(slow.join(), 101U);
  // More answers than sockets hold: meanwhile frames are left out for this page.
  constexpr int kAnswers = 12;
  for (int i = 0; i < kAnswers; ++i) ASSERT_TRUE(slow.say_message(all_rows()));
  std::this_thread::sleep_for(500ms);
  publish(served, 5);
  for (int i = 0; i < kAnswers; ++i) ASSERT_NE(slow.next_of<Rows>(Body::Rows), nullptr) << i;
  publish(served, 1);
  const Frame* frame = slow.next_of<Frame>(
      Body::Frame, [](const Frame& f) { return f.timing()->lost_frames() > 0; });
  ASSERT_NE(frame, nullptr);
  EXPECT_GE(frame->timing()->lost_frames(), 1U);
  EXPECT_LE(frame->timing()->lost_frames(), 7U);  // as many as there were states
  std::string body;
  Client counters(served.port);
  counters.get("/metrics");
  EXPECT_EQ(counters.answer(&body), 200U);
  EXPECT_EQ(body, "lost_frames " + std::to_string(frame->timing()->lost_frames()) + "\n");
}

// It is closed once for the number of answers that wait for it, and once for their size. It goes on
// asking, often enough not to be closed as idle, and not so often that it is closed for too many
// messages.
TEST(Server, APageThatAsksButNeverReadsIsClosed) {
  for (const bool large : {false, true}) {
    Served served;
    if (large) tell_many_rows(served);
    if (!large) served.run_all();
    std::this_thread::sleep_for(3 * kFramePause);  // before it has rows, answers are too small
    const std::uint32_t asks = large ? 60 : kMaxMessagesPerSecond - 100;
    Client deaf(served.port, 4096);
    ASSERT_EQ(deaf.join(), 101U);
    bool open = true;
    for (std::uint32_t i = 0; open && i < asks; ++i) open = deaf.say_message(all_rows());
    for (int i = 0; open && i < 600; ++i) {
      std::this_thread::sleep_for(100ms);
      open = deaf.say_frame("", 9);
    }
    EXPECT_FALSE(open) << large;
    expect_alive(served);
  }
}

TEST(Server, AnyPageMayMarkAndALateOneGetsAllMarksAndScores) {
  Served served;
  served.run_all();
  for (std::uint32_t i = 1; i <= kMaxScoresKept; ++i) {
    served.server->show(ScoredAttempt{i, "", "", "", {}});
  }
  Client first(served.port), teacher(served.port);
  ASSERT_EQ(first.join(), 101U);
  ASSERT_EQ(teacher.join(), 101U);
  const Hello* hello = teacher.next_of<Hello>(Body::Hello);
  ASSERT_NE(hello, nullptr);
  EXPECT_FALSE(hello->may_control());
  ASSERT_NE(teacher.next_of<Frame>(Body::Frame), nullptr);
  for (std::size_t i = 0; i <= kMaxMarksKept; ++i) {
    teacher.say_message(page_message(Body::Mark, [i](auto& b) {
      return CreateMark(b, b.CreateString("line\none " + std::to_string(i)));
    }));
  }
  const std::string last = "line one " + std::to_string(kMaxMarksKept);
  const auto is_last = [&last](const Marked& m) { return m.text()->str() == last; };
  ASSERT_NE(first.next_of<Marked>(Body::Marked, is_last), nullptr);
  Client late(served.port);
  ASSERT_EQ(late.join(), 101U);
  const Score* score = late.next_of<Score>(Body::Score);
  ASSERT_NE(score, nullptr);
  EXPECT_EQ(score->attempt(), 1U);
  const Marked* mark = late.next_of<Marked>(Body::Marked);
  ASSERT_NE(mark, nullptr);
  EXPECT_EQ(mark->text()->str(), "line one 1");  // the very first is forgotten
  EXPECT_EQ(mark->tick(), served.config.ticks);
  EXPECT_NE(late.next_of<Marked>(Body::Marked, is_last), nullptr);
  const std::lock_guard lock(served.mutex);
  EXPECT_EQ(served.orders.size(), kMaxMarksKept + 1);
  EXPECT_EQ(served.orders.back().tick, served.config.ticks);
}

// What the others receive is complete, beside a client that never reads.
TEST(Server, AClientThatNeverReadsTakesNothingFromTheOthers) {
  Served served;
  Client asleep(served.port), awake(served.port);
  ASSERT_EQ(asleep.join(), 101U);
  ASSERT_EQ(awake.join(), 101U);
  ASSERT_NE(awake.next_of<Hello>(Body::Hello), nullptr);
  served.run_all();
  const std::uint64_t last = served.config.ticks;
  const Frame* frame =
      awake.next_of<Frame>(Body::Frame, [last](const Frame& f) { return f.tick() == last; });
  EXPECT_NE(frame, nullptr);
}

}  // namespace
}  // namespace stylet::console::test
