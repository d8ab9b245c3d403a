// SPDX-License-Identifier: Apache-2.0
// Who may ask the console for what.
#include "hal/console/gate.h"

#include <gtest/gtest.h>

namespace stylet::console {
namespace {

const GateConfig kLocal = {"127.0.0.1", 7760, ""};
const GateConfig kOpen = {"192.168.0.5", 7760, "5ec7e7"};

GateAnswer ask(const GateConfig& config, std::string_view target, std::string_view host,
               std::string_view origin = "", std::string_view method = "GET") {
  return judge(config, {method, target, host, origin});
}

TEST(Gate, ServesSixPlacesAndNothingElse) {
  const char* host = "127.0.0.1:7760";
  EXPECT_EQ(ask(kLocal, "/", host).place, Place::kPage);
  EXPECT_EQ(ask(kLocal, "/app.js", host).place, Place::kScript);
  EXPECT_EQ(ask(kLocal, "/app.css?x", host).place, Place::kStyle);
  EXPECT_EQ(ask(kLocal, "/organ", host).place, Place::kOrgan);
  EXPECT_EQ(ask(kLocal, "/metrics", host).place, Place::kMetrics);
  EXPECT_EQ(ask(kLocal, "/ws?token=x", host).place, Place::kSocket);
  for (const char* other : {"", "/index.html", "//", "/../etc/passwd", "/organ/", "/app.js%00",
                            "http://127.0.0.1:7760/", "/%2e%2e/organ", "*"}) {
    EXPECT_EQ(ask(kLocal, other, host).status, 404U) << other;
  }
  EXPECT_EQ(ask(kLocal, "/", host, "", "POST").status, 405U);
  EXPECT_EQ(ask(kLocal, "/organ", host, "", "DELETE").status, 405U);
}

TEST(Gate, KnowsItsOwnNameOnly) {
  for (const char* host : {"127.0.0.1:7760", "localhost:7760", "[::1]:7760", "127.1.2.3:7760"}) {
    EXPECT_EQ(ask(kLocal, "/", host).status, 200U) << host;
  }
  for (const char* host :
       {"", "127.0.0.1", "127.0.0.1:80", "evil.example:7760", "[::1]", "::1:7760",
        "localhost.evil.example:7760", "192.168.0.5:7760", "127.0.0.1:7760:7760"}) {
    EXPECT_EQ(ask(kLocal, "/", host).status, 403U) << host;
  }
  EXPECT_EQ(ask(kOpen, "/", "192.168.0.5:7760").status, 200U);
  EXPECT_EQ(ask(kOpen, "/", "lab.example:7760").status, 403U);
}

TEST(Gate, PagesOfOtherSitesAreRefused) {
  const char* host = "127.0.0.1:7760";
  EXPECT_EQ(ask(kLocal, "/ws", host, "http://127.0.0.1:7760").status, 200U);
  for (const char* origin : {"http://evil.example", "http://127.0.0.1:7761", "null",
                             "https://127.0.0.1:7760", "http://localhost:7760"}) {
    EXPECT_EQ(ask(kLocal, "/ws", host, origin).status, 403U) << origin;
  }
}

TEST(Gate, EverythingButThePageNeedsTheToken) {
  const char* host = "192.168.0.5:7760";
  for (const char* open : {"/", "/app.js", "/app.css"}) {
    EXPECT_EQ(ask(kOpen, open, host).status, 200U) << open;
  }
  for (const std::string place : {"/ws", "/organ", "/metrics"}) {
    EXPECT_EQ(ask(kOpen, place, host).status, 401U);
    EXPECT_EQ(ask(kOpen, place + "?token=", host).status, 401U);
    EXPECT_EQ(ask(kOpen, place + "?token=5ec7e8", host).status, 401U);
    EXPECT_EQ(ask(kOpen, place + "?token=5ec7e70", host).status, 401U);
    EXPECT_EQ(ask(kOpen, place + "?nottoken=5ec7e7", host).status, 401U);
    EXPECT_EQ(ask(kOpen, place + "?token=5ec7e7", host).status, 200U);
    EXPECT_EQ(ask(kOpen, place + "?a=b&token=5ec7e7&c", host).status, 200U);
  }
}

TEST(Gate, TokensAreLongAndNeverTheSame) {
  const std::string one = new_token(), other = new_token();
  EXPECT_EQ(one.size(), 32U);
  EXPECT_NE(one, other);
  EXPECT_TRUE(same_secret(one, one));
  EXPECT_FALSE(same_secret(one, other));
  EXPECT_FALSE(same_secret(one, one.substr(1)));
}

}  // namespace
}  // namespace stylet::console
