#include "devices/link/tcp_line.h"

#include <array>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "tests/devices/link/tcp_peer.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

std::string echo(std::string_view bytes, double /*now_s*/) { return std::string(bytes); }

std::string read_all(ByteTransport& line, const Clock& clock, std::size_t wanted) {
    std::string text;
    std::array<char, 1000> bytes{};
    const SessionTime deadline = clock.now() + 20s;
    while (text.size() < wanted && !line.lost() && clock.now() < deadline)
        text.append(bytes.data(), line.read(bytes, deadline));
    return text;
}

/// A port of this machine at which nothing listens: one that was bound and given back.
NetworkAddress nobody() { return TcpPeer(echo).address(); }

} // namespace

TEST_CASE("a TCP line carries every byte both ways unchanged", "[unit]") {
    const SteadyClock clock;
    const TcpPeer peer(echo);
    TcpLine line(peer.address(), "test server", clock, clock.now() + 20s);
    CHECK_THAT(line.name(), Contains("127.0.0.1:"));
    std::string all;
    for (unsigned i = 0; i < 100'000; ++i)
        all += static_cast<char>(i * i / 7);
    REQUIRE(line.write(all, clock.now() + 20s));
    CHECK(read_all(line, clock, all.size()) == all);
}

TEST_CASE("a TCP line waits no longer than the deadline", "[unit]") {
    const SteadyClock clock;
    const TcpPeer peer(echo);
    TcpLine line(peer.address(), "test server", clock, clock.now() + 20s);
    std::array<char, 8> bytes{};
    const SessionTime deadline = clock.now() + 30ms;
    CHECK(line.read(bytes, deadline) == 0);
    CHECK(clock.now() >= deadline);
    CHECK(line.read(bytes, SessionTime()) == 0);
    CHECK_FALSE(line.lost());
}

TEST_CASE("what a stalled server does not take is not written for ever", "[unit]") {
    const SteadyClock clock;
    TcpPeer peer(echo);
    TcpLine line(peer.address(), "test server", clock, clock.now() + 20s);
    peer.stall(true);
    CHECK_FALSE(line.write(std::string(64 << 20, 'x'), clock.now() + 100ms));
    CHECK_FALSE(line.lost());
}

TEST_CASE("a TCP line whose server goes away is lost after its last bytes, and writing raises no signal",
          "[unit]") {
    const SteadyClock clock;
    TcpPeer peer(echo);
    TcpLine line(peer.address(), "test server", clock, clock.now() + 20s);
    REQUIRE(line.write("bye", clock.now() + 20s));
    CHECK(read_all(line, clock, 3) == "bye");
    peer.drop();
    std::array<char, 8> bytes{};
    CHECK(line.read(bytes, clock.now() + 20s) == 0);
    CHECK(line.lost());
    CHECK(line.loss() == "the other end closed the connection");
    CHECK_FALSE(line.write("x", clock.now() + 1s));
    TcpLine again(peer.address(), "test server", clock, clock.now() + 20s);
    REQUIRE(again.write("hi", clock.now() + 20s));
    CHECK(read_all(again, clock, 2) == "hi");
}

TEST_CASE("a server that is gone when something is written to it ends the line and not the program",
          "[unit]") {
    const SteadyClock clock;
    TcpPeer peer(echo);
    TcpLine line(peer.address(), "test server", clock, clock.now() + 20s);
    REQUIRE(line.write("x", clock.now() + 20s));
    CHECK(read_all(line, clock, 1) == "x");
    peer.drop();
    const SessionTime give_up = clock.now() + 20s;
    while (!line.lost() && clock.now() < give_up)
        line.write("more", clock.now() + 10ms);
    CHECK(line.lost());
}

TEST_CASE("a server that is not there is refused with its address and a remedy", "[unit]") {
    const SteadyClock clock;
    const NetworkAddress address = nobody();
    CHECK_THROWS_WITH(TcpLine(address, "eye tracker", clock, clock.now() + 20s),
                      Contains("eye tracker at " + describe(address)) && Contains("Connection refused") &&
                          Contains("nothing listens there"));
    CHECK_THROWS_WITH(TcpLine({"no such host", 4242}, "eye tracker", clock, clock.now() + 20s),
                      Contains("\"no such host\" is no known host"));
    CHECK(describe(NetworkAddress{"::1", 7}) == "[::1]:7");
}

TEST_CASE("a connection that nobody takes ends with its deadline", "[unit]") {
    const SteadyClock clock;
    // Connections beyond those that wait already get no answer at all, as from a machine behind a firewall.
    const int listener = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    REQUIRE(bind(listener, reinterpret_cast<sockaddr*>(&address), size) == 0);
    REQUIRE(listen(listener, 0) == 0);
    REQUIRE(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    const NetworkAddress there{"127.0.0.1", ntohs(address.sin_port)};
    const TcpLine waiting(there, "first", clock, clock.now() + 20s);
    const SessionTime deadline = clock.now() + 50ms;
    CHECK_THROWS_WITH(TcpLine(there, "eye tracker", clock, deadline),
                      Contains("Connection timed out") && Contains("firewall"));
    CHECK(clock.now() >= deadline);
    close(listener);
}

TEST_CASE("an address is a host with or without a port, and what is left out is as usual", "[unit]") {
    const NetworkAddress usual{"127.0.0.1", 4242};
    const auto read = [&](std::string_view text) { return describe(parse_network_address(text, usual)); };
    CHECK(read("") == "127.0.0.1:4242");
    CHECK(read("lab-pc") == "lab-pc:4242");
    CHECK(read("10.0.0.7:80") == "10.0.0.7:80");
    CHECK(read(":5000") == "127.0.0.1:5000");
    CHECK(read("fe80::1") == "[fe80::1]:4242");
    CHECK(read("[fe80::1]") == "[fe80::1]:4242");
    CHECK(read("[fe80::1]:7") == "[fe80::1]:7");
    for (const char* wrong : {"host:", "host:0", "host:70000", "host:4242x", "[::1]:x"})
        CHECK_THROWS_WITH(parse_network_address(wrong, usual),
                          Contains("is no port") && Contains("127.0.0.1:4242"));
}
