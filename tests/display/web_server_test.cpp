// The web server against strangers: bad requests, bad messages and silence.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <vector>

#include "display/view/viewer_host.h"
#include "display/web/assets.h"
#include "tests/support/web_client.h"

namespace swath::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace asio = boost::asio;

std::string text_of(const Asset& asset) {
    return {reinterpret_cast<const char*>(asset.bytes.data()), asset.bytes.size()};
}

class WebServerTest : public testing::Test {
  protected:
    void SetUp() override { start({}); }

    void start(const WebServer::Options& options) {
        host_.reset();
        auto made = ViewerHost::make(options, clock_);
        ASSERT_TRUE(made.has_value()) << made.error().message;
        host_ = std::move(*made);
        // Tests of a server off loopback still connect by loopback.
        address_ = {"127.0.0.1", host_->address().port};
    }
    void start_with_token() {
        start({{"0.0.0.0", 0}, {}});
        const std::string& url = host_->url();
        token_ = url.substr(url.find("?token=") + 7);
    }
    HttpAnswer get(const std::string& target, const std::string& fields = {}) const {
        return http_get(address_, target, fields);
    }
    // `line` is method, target and version; the Host is right.
    HttpAnswer ask(const std::string& line, const std::string& fields = {}) const {
        return http_exchange(address_,
                             fmt::format("{}\r\nHost: {}\r\n{}\r\n", line, to_string(address_), fields));
    }
    HttpAnswer ask_host(const std::string& host) const {
        return http_exchange(address_, fmt::format("GET / HTTP/1.1\r\n{}Connection: close\r\n\r\n", host));
    }
    std::unique_ptr<WebClient> viewer() const {
        auto made = WebClient::connect(address_, token_);
        EXPECT_TRUE(made.has_value()) << made.error().message;
        return made ? std::move(*made) : nullptr;
    }
    std::string refusal(const WebClient::Options& options) const {
        const auto made = WebClient::connect(address_, options);
        return made ? "not refused" : made.error().message;
    }
    // A new visitor finds everything as ever.
    void expect_all_is_well() const {
        EXPECT_EQ(
            get("/", token_.empty() ? "" : fmt::format("Cookie: {}={}\r\n", cookie_name(), token_)).status,
            200);
        const auto one = viewer();
        ASSERT_NE(one, nullptr);
        const auto heard = one->next();
        ASSERT_TRUE(heard.has_value());
        EXPECT_THAT(heard->bytes, StartsWith(R"({"type":"audience","you":)"));
    }
    std::string cookie_name() const { return fmt::format("swath-{}", address_.port); }

    SteadyClock clock_;
    std::unique_ptr<ViewerHost> host_;
    Address address_;
    std::string token_;
};

// The page.

TEST(Page, IsThereAndSmall) {
    std::size_t bytes = 0;
    bool index = false;
    for (const Asset& asset : assets()) {
        EXPECT_THAT(std::string(asset.path), StartsWith("/"));
        index = index || asset.path == "/index.html";
        bytes += asset.bytes.size();
    }
    EXPECT_TRUE(index);
    EXPECT_LE(bytes, std::size_t{300} << 10);
}

TEST_F(WebServerTest, ServesThePageAndItsPartsAsTheyAre) {
    for (const Asset& asset : assets()) {
        const HttpAnswer answer = get(std::string(asset.path));
        EXPECT_EQ(answer.status, 200) << asset.path;
        EXPECT_EQ(answer.body, text_of(asset)) << asset.path;
        EXPECT_THAT(answer.head, HasSubstr(fmt::format("Content-Type: {}\r\n", asset.content_type)));
    }
    const HttpAnswer page = get("/");
    EXPECT_EQ(page.body, get("/index.html").body);
    EXPECT_EQ(get("/?something=else").body, page.body);
    EXPECT_THAT(page.head, HasSubstr("\r\nContent-Type: text/html; charset=utf-8\r\n"));
}

TEST_F(WebServerTest, TellsTheBrowserToLetNothingElseIn) {
    EXPECT_THAT(
        get("/").head,
        AllOf(HasSubstr("\r\nX-Content-Type-Options: nosniff\r\n"), HasSubstr("Cache-Control: no-store\r\n"),
              HasSubstr("\r\nReferrer-Policy: no-referrer\r\n"), HasSubstr("default-src 'self';"),
              HasSubstr("frame-ancestors 'none'"),
              HasSubstr(fmt::format("connect-src 'self' ws://{};", to_string(address_)))));
}

TEST_F(WebServerTest, AnswersHeadWithoutTheBody) {
    const HttpAnswer answer = ask("HEAD / HTTP/1.1", "Connection: close\r\n");
    EXPECT_EQ(answer.status, 200);
    EXPECT_THAT(answer.head, HasSubstr(fmt::format("Content-Length: {}\r\n", get("/").body.size())));
    EXPECT_EQ(answer.body, "");
    EXPECT_EQ(ask("HEAD /none HTTP/1.1", "Connection: close\r\n").body, "");
}

TEST_F(WebServerTest, AnswersSeveralRequestsOnAConnection) {
    const std::string host = "Host: " + to_string(address_) + "\r\n";
    const HttpAnswer answer =
        http_exchange(address_, "GET /none HTTP/1.1\r\n" + host + "\r\n" + "GET / HTTP/1.1\r\n" + host +
                                    "Connection: close\r\n\r\n");
    EXPECT_EQ(answer.status, 404);
    EXPECT_THAT(answer.body, AllOf(HasSubstr("HTTP/1.1 200 OK"), HasSubstr(get("/").body)));
}

TEST_F(WebServerTest, HasNothingElse) {
    EXPECT_EQ(get("/none").status, 404);
    EXPECT_EQ(get("/../web/index.html").status, 404);
    EXPECT_EQ(get("/%69ndex.html").status, 404);
    EXPECT_EQ(get("//").status, 404);
    EXPECT_EQ(get("*").status, 404);
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "NONSENSE"}) {
        const HttpAnswer answer = ask(fmt::format("{} / HTTP/1.1", method));
        EXPECT_EQ(answer.status, 405) << method;
        EXPECT_THAT(answer.head, HasSubstr("\r\nAllow: GET, HEAD\r\n"));
    }
}

// Bad requests.

TEST_F(WebServerTest, RefusesWhatIsNotHttp) {
    for (const std::string& request :
         {std::string("hello\r\n\r\n"), std::string("GET / HTTP/9\r\n\r\n"),
          std::string("GET  HTTP/1.1\r\n\r\n"), std::string("GET / HTTP/1.1\r\nno colon\r\n\r\n"),
          std::string("GET / HTTP/1.1\r\nA: \x01\r\n\r\n"),
          std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11), std::string(100, '\0'),
          std::string("SWTH\x03\x00\x00\x00", 8)})
        EXPECT_EQ(http_exchange(address_, request).status, 400) << request;
    expect_all_is_well();
}

TEST_F(WebServerTest, RefusesBodies) {
    EXPECT_EQ(ask("GET / HTTP/1.1", "Content-Length: 3\r\n").status, 413);
    EXPECT_EQ(ask("POST / HTTP/1.1", "Content-Length: 99999999999\r\n").status, 413);
    EXPECT_EQ(ask("POST / HTTP/1.1", "Transfer-Encoding: chunked\r\n").status, 413);
    EXPECT_EQ(ask("POST / HTTP/1.1", "Content-Length: -1\r\n").status, 400);
    const std::string post = fmt::format("POST / HTTP/1.1\r\nHost: {}\r\nContent-Length: 100000\r\n\r\n{}",
                                         to_string(address_), std::string(100'000, 'x'));
    EXPECT_EQ(http_exchange(address_, post).status, 413);
    expect_all_is_well();
}

TEST_F(WebServerTest, RefusesHeadsOverTheirLimit) {
    EXPECT_EQ(get("/", fmt::format("X: {}\r\n", std::string(7'000, 'x'))).status, 200);
    EXPECT_EQ(get("/", fmt::format("X: {}\r\n", std::string(9'000, 'x'))).status, 431);
    EXPECT_EQ(get("/" + std::string(9'000, 'x')).status, 431);
    std::string many;
    for (int i = 0; i < 100'000; ++i) many += "X: y\r\n";
    EXPECT_EQ(http_exchange(address_, "GET / HTTP/1.1\r\n" + many).status, 431);
    expect_all_is_well();
}

TEST_F(WebServerTest, HangsUpOnHeadsThatDoNotEnd) {
    WebServer::Options options;
    options.limits.head_time = std::chrono::milliseconds(100);
    start(options);
    EXPECT_EQ(http_exchange(address_, "GET / HTTP/1.1\r\nHost: ").status, 0);
    EXPECT_EQ(http_exchange(address_, "").status, 0);
    expect_all_is_well();
}

// Admission.

TEST_F(WebServerTest, OnLoopbackIsAskedForByItsOwnNamesOnly) {
    const std::uint16_t port = address_.port;
    for (const std::string& host : {fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port),
                                    fmt::format("LocalHost:{}", port), fmt::format("[::1]:{}", port)})
        EXPECT_EQ(ask_host("Host: " + host + "\r\n").status, 200) << host;
    for (const std::string& host :
         {fmt::format("evil.example:{}", port), fmt::format("127.0.0.1.evil.example:{}", port),
          fmt::format("localhost.:{}", port), std::string("localhost"), std::string("localhost:1"),
          std::string(), fmt::format("127.0.0.1:{};", port)})
        EXPECT_EQ(ask_host("Host: " + host + "\r\n").status, 403) << host;
    EXPECT_EQ(ask_host("").status, 403);
    const std::string ours = fmt::format("Host: 127.0.0.1:{}\r\n", port);
    EXPECT_NE(ask_host(ours + ours).status, 200);
}

TEST_F(WebServerTest, TakesViewersFromItsOwnPageOnly) {
    WebClient::Options options;
    options.origin = "none";
    EXPECT_EQ(refusal(options), "403 no origin\n");
    for (const std::string& origin :
         {std::string("http://evil.example"), std::string("null"), "https://" + to_string(address_),
          "http://" + to_string(address_) + "0", fmt::format("http://localhost:{}", address_.port),
          "http://" + to_string(address_) + "/"}) {
        options.origin = origin;
        EXPECT_EQ(refusal(options), "403 a page of another origin\n") << origin;
    }
    options.origin.clear();
    options.host = fmt::format("evil.example:{}", address_.port);  // a name made to point here
    EXPECT_EQ(refusal(options), "403 not this host\n");
    options.host = fmt::format("localhost:{}", address_.port);
    EXPECT_EQ(refusal(options), "not refused");
}

TEST_F(WebServerTest, OffLoopbackTakesNobodyWithoutTheToken) {
    start_with_token();
    EXPECT_THAT(token_, testing::MatchesRegex("[0-9a-f]{64}"));
    const std::string wrong(64, '0');
    for (const std::string& target :
         {std::string("/"), std::string("/index.html"), std::string("/live"), std::string("/none"),
          std::string("/?token="), "/?token=" + wrong, "/?token=" + token_.substr(1),
          "/?token=" + token_ + "0", "/?Token=" + token_, "/" + token_})
        EXPECT_EQ(get(target).status, 403) << target;
    for (const std::string& cookie : {cookie_name() + "=" + wrong, cookie_name() + "=", "swath-1=" + token_,
                                      token_, "x" + cookie_name() + "=" + token_})
        EXPECT_EQ(get("/", "Cookie: " + cookie + "\r\n").status, 403) << cookie;
    EXPECT_THAT(refusal({}), StartsWith("403 this needs the token"));
    WebClient::Options options;
    options.token = wrong;
    EXPECT_THAT(refusal(options), StartsWith("403 this needs the token"));
}

TEST_F(WebServerTest, AnswersTheTokenWithACookieForTheRest) {
    start_with_token();
    const HttpAnswer page = get("/?token=" + token_);
    EXPECT_EQ(page.status, 200);
    EXPECT_THAT(page.head,
                HasSubstr(fmt::format("\r\nSet-Cookie: {}={}; Path=/; HttpOnly; SameSite=Strict\r\n",
                                      cookie_name(), token_)));
    const std::string cookie = fmt::format("other=1; {}={}", cookie_name(), token_);
    EXPECT_EQ(get("/", "Cookie: " + cookie + "\r\n").status, 200);
    EXPECT_EQ(get("/?x=y&token=" + token_).status, 200);
    EXPECT_EQ(
        http_exchange(
            address_,
            fmt::format("GET /?token={} HTTP/1.1\r\nHost: any.example\r\nConnection: close\r\n\r\n", token_))
            .status,
        200);
    WebClient::Options options;
    options.cookie = cookie;
    EXPECT_EQ(refusal(options), "not refused");
    options.origin = "http://evil.example";
    EXPECT_EQ(refusal(options), "403 a page of another origin\n");
    expect_all_is_well();
}

TEST_F(WebServerTest, MakesANewTokenEachTime) {
    start_with_token();
    const std::string first = token_;
    start_with_token();
    EXPECT_NE(token_, first);
}

// WebSockets.

TEST_F(WebServerTest, UpgradesOnlyWhatAsksForAWebSocketProperly) {
    EXPECT_EQ(get("/live").status, 426);
    const std::string origin = fmt::format("Origin: http://{}\r\n", to_string(address_));
    const std::string upgrade = "Connection: Upgrade\r\nUpgrade: websocket\r\n" + origin;
    EXPECT_NE(ask("GET /live HTTP/1.1", upgrade + "Sec-WebSocket-Version: 13\r\n").status, 101);  // no key
    EXPECT_NE(ask("GET /live HTTP/1.1",
                  upgrade + "Sec-WebSocket-Version: 8\r\nSec-WebSocket-Key: AQIDBAUGBwgJCgsMDQ4PEA==\r\n")
                  .status,
              101);
    EXPECT_EQ(ask("GET /live HTTP/1.0", upgrade).status, 426);
    EXPECT_EQ(ask("POST /live HTTP/1.1", upgrade).status, 405);
    expect_all_is_well();
}

TEST_F(WebServerTest, EndsAViewerWhoseMessagesAreNone) {
    const auto ending_after = [&](std::string_view message, bool text) {
        const auto one = viewer();
        EXPECT_TRUE(one->next().has_value());
        one->send(message, text);
        while (one->next()) {
        }
        return one->close_code().value_or(0);
    };
    constexpr int kBadPayload = 1007;
    constexpr int kPolicy = 1008;
    constexpr int kTooBig = 1009;
    constexpr int kNoClose = 1006;
    // The rest of the message is not read, and the reset can overtake the close.
    EXPECT_THAT(ending_after(std::string(20'000, ' '), true), testing::AnyOf(kTooBig, kNoClose));
    EXPECT_EQ(ending_after(R"({"type": "lead"})", false), 1003);
    EXPECT_EQ(ending_after("\xff\xfe", true), kBadPayload);
    const std::string deep = std::string(16'000, '[');
    for (const std::string_view text :
         {std::string_view(""), std::string_view("{"), std::string_view("[]"), std::string_view("1"),
          std::string_view(R"({})"), std::string_view(R"({"type": 1})"),
          std::string_view(R"({"type": "none"})"), std::string_view(R"({"type": "shown"})"),
          std::string_view(R"({"type": "shown", "frame": -1, "stream": 0, "format": "jpeg"})"),
          std::string_view(R"({"type": "shown", "frame": 1.5, "stream": 0, "format": "jpeg"})"),
          std::string_view(R"({"type": "shown", "frame": 1, "stream": 2, "format": "jpeg"})"),
          std::string_view(R"({"type": "shown", "frame": 1, "stream": 1e99, "format": "jpeg"})"),
          std::string_view(R"({"type": "shown", "frame": 1, "stream": 0, "format": "gif"})"),
          std::string_view(R"({"type": "shown", "frame": 1, "stream": 0, "format": []})"),
          std::string_view(deep)})
        EXPECT_EQ(ending_after(text, true), kPolicy) << text.substr(0, 100);
    expect_all_is_well();
    EXPECT_LE(host_->numbers().viewers, 1u);
}

TEST_F(WebServerTest, TakesTheLongestMessageThatIsAllowed) {
    const auto one = viewer();
    one->next();
    const auto two = viewer();
    two->next();
    std::string text = R"({"type": "lead"})";
    text.resize(kMaxWishBytes, ' ');
    EXPECT_TRUE(two->send(text));
    EXPECT_THAT(two->next()->bytes, HasSubstr(R"("lead":2)"));
}

TEST_F(WebServerTest, SurvivesViewersThatVanishAtAnyMoment) {
    for (int i = 0; i < 50; ++i) {
        const auto one = viewer();
        ASSERT_NE(one, nullptr);
        if (i % 2 == 0) one->next();
        one->close();
    }
    expect_all_is_well();
}

TEST_F(WebServerTest, GarbageOnAWebSocketEndsItOnly) {
    const auto good = viewer();
    ASSERT_TRUE(good->next().has_value());
    const std::string upgrade = fmt::format(
        "GET /live HTTP/1.1\r\nHost: {0}\r\nOrigin: http://{0}\r\nConnection: Upgrade\r\nUpgrade: "
        "websocket\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AQIDBAUGBwgJCgsMDQ4PEA==\r\n\r\n",
        to_string(address_));
    asio::io_context io;
    for (const std::string& garbage :
         {std::string("\x81\x05hello", 7), std::string(1000, '\xff'), std::string("\xc1\x80\0\0\0\0", 6),
          std::string("\x81\xff\xff\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14)}) {
        asio::ip::tcp::socket socket(io);
        socket.connect({asio::ip::make_address(address_.host), address_.port});
        asio::write(socket, asio::buffer(upgrade));
        std::string head;
        asio::read_until(socket, asio::dynamic_buffer(head), "\r\n\r\n");
        EXPECT_THAT(head, StartsWith("HTTP/1.1 101"));
        asio::write(socket, asio::buffer(garbage));
        boost::system::error_code ended;
        std::array<char, 4096> bytes{};
        while (!ended) socket.read_some(asio::buffer(bytes), ended);
    }
    EXPECT_EQ(good->close_code(), std::nullopt);
    expect_all_is_well();
}

// Limits.

TEST_F(WebServerTest, HasSoManyViewersAndTellsOneMore) {
    WebServer::Options options;
    options.limits.viewers = 2;
    start(options);
    auto one = viewer();
    const auto two = viewer();
    EXPECT_EQ(refusal({}), "503 too many viewers\n");
    one->close();
    // Its slot is free as soon as the server has seen it go.
    std::string said;
    for (int i = 0; i < 1000 && said != "not refused"; ++i) said = refusal({});
    EXPECT_EQ(said, "not refused");
}

TEST_F(WebServerTest, HearsSoManyConnectionsAndTurnsTheRestAway) {
    WebServer::Options options;
    options.limits.connections = 4;
    start(options);
    asio::io_context io;
    std::vector<asio::ip::tcp::socket> idle;
    const auto open = [&] {
        idle.emplace_back(io).connect({asio::ip::make_address(address_.host), address_.port});
    };
    for (int i = 0; i < 4; ++i) open();
    const HttpAnswer answer = get("/");
    EXPECT_EQ(answer.status, 503);
    EXPECT_EQ(answer.body, "too many connections\n");
    idle.clear();
    HttpAnswer later;
    for (int i = 0; i < 1000 && later.status != 200; ++i) later = get("/");
    EXPECT_EQ(later.status, 200);
}

TEST_F(WebServerTest, SurvivesAThousandConnections) {
    const auto good = viewer();
    ASSERT_TRUE(good->next().has_value());
    asio::io_context io;
    std::vector<asio::ip::tcp::socket> idle;
    for (int i = 0; i < 1000; ++i) {
        boost::system::error_code failed;
        asio::ip::tcp::socket& socket = idle.emplace_back(io);
        socket.connect({asio::ip::make_address(address_.host), address_.port}, failed);
        if (i % 2 == 0) asio::write(socket, asio::buffer(std::string_view("GET / HT")), failed);
    }
    idle.clear();
    HttpAnswer later;
    for (int i = 0; i < 1000 && later.status != 200; ++i) later = get("/");
    expect_all_is_well();
    EXPECT_THAT(good->next()->bytes, HasSubstr(R"("viewers":2)"));  // it has been there all the time
}

TEST(WebServerStart, SaysThatAPortIsTaken) {
    const SteadyClock clock;
    const auto first = ViewerHost::make({}, clock);
    ASSERT_TRUE(first.has_value());
    const Address taken = (*first)->address();
    const auto second = ViewerHost::make({taken, {}}, clock);
    ASSERT_FALSE(second.has_value());
    EXPECT_EQ(second.error().message,
              fmt::format("cannot listen on {}: Address already in use", to_string(taken)));
    EXPECT_EQ((*first)->url(), fmt::format("http://{}/", to_string(taken)));
}

}  // namespace
}  // namespace swath::test
