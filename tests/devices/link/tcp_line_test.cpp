#include "devices/link/tcp_line.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <optional>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>

#include "devices/host/clocks.h"
#include "devices/link/network_cards.h"
#include "experiment/base/error.h"
#include "tests/devices/link/tcp_peer.h"
#include "tests/support/next_function.h"

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

namespace {

/// The sockets that this program has open.
std::vector<int> open_sockets() {
    std::vector<int> all;
    for (int descriptor = 0; descriptor < 1024; ++descriptor) {
        // By name: other threads may be closing theirs.
        std::error_code none;
        if (std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", descriptor), none)
                .string()
                .starts_with("socket:"))
            all.push_back(descriptor);
    }
    return all;
}

int option_of(int descriptor, int level, int option) {
    int value = -1;
    socklen_t size = sizeof value;
    getsockopt(descriptor, level, option, &value, &size);
    return value;
}

/// Network cards of the test's own, in place of the system's; nothing: those of the system.
std::optional<std::vector<ifaddrs>> cards_of_test;
bool cards_fail = false;
int cards_freed = 0;

} // namespace

// They take the place of the C library's for this program.
extern "C" {
int getifaddrs(ifaddrs** first) noexcept {
    if (!cards_of_test)
        return next_function<decltype(getifaddrs)>("getifaddrs")(first);
    for (std::size_t i = 0; i < cards_of_test->size(); ++i)
        (*cards_of_test)[i].ifa_next = i + 1 < cards_of_test->size() ? &(*cards_of_test)[i + 1] : nullptr;
    *first = cards_of_test->empty() ? nullptr : cards_of_test->data();
    return cards_fail ? -1 : 0;
}
void freeifaddrs(ifaddrs* first) noexcept {
    if (!cards_of_test)
        return next_function<decltype(freeifaddrs)>("freeifaddrs")(first);
    ++cards_freed;
}
}

TEST_CASE("a TCP line sends at once, and finds a dead peer within ten seconds", "[unit]") {
    const SteadyClock clock;
    const TcpPeer peer(echo);
    const std::vector<int> before = open_sockets();
    {
        TcpLine line(peer.address(), "test server", clock, clock.now() + 20s);
        CHECK(line.write("x", clock.now() + 20s));
        CHECK(read_all(line, clock, 1) == "x"); // the peer has taken it by now
        int own = -1;
        for (const int descriptor : open_sockets())
            if (std::ranges::find(before, descriptor) == before.end() &&
                option_of(descriptor, IPPROTO_TCP, TCP_NODELAY) == 1)
                own = descriptor;
        REQUIRE(own >= 0);
        CHECK(option_of(own, SOL_SOCKET, SO_KEEPALIVE) == 1);
        CHECK(option_of(own, IPPROTO_TCP, TCP_KEEPIDLE) == 4);
        CHECK(option_of(own, IPPROTO_TCP, TCP_KEEPINTVL) == 2);
        CHECK(option_of(own, IPPROTO_TCP, TCP_KEEPCNT) == 3);
        CHECK(option_of(own, IPPROTO_TCP, TCP_USER_TIMEOUT) == 10'000);
        CHECK((fcntl(own, F_GETFL) & O_NONBLOCK) != 0);
        CHECK((fcntl(own, F_GETFD) & FD_CLOEXEC) != 0);
    }
    CHECK_THROWS_AS(TcpLine(nobody(), "test server", clock, clock.now() + 20s), DeviceError);
    CHECK_THROWS_AS(TcpLine({"no such host", 4242}, "test server", clock, clock.now() + 20s), DeviceError);
    std::vector<int> left = open_sockets();
    std::erase_if(left,
                  [&](int descriptor) { return std::ranges::find(before, descriptor) != before.end(); });
    CHECK(left.size() <= 1); // the peer's own end
}

TEST_CASE("whether a program answers where it usually does is said", "[unit]") {
    const TcpPeer peer(echo);
    CHECK(served_here(peer.address(), "Gazepoint Control") ==
          "Gazepoint Control answers at " + describe(peer.address()));
    const NetworkAddress empty = nobody();
    CHECK(served_here(empty, "Pupil Capture") ==
          "Pupil Capture does not answer at " + describe(empty) +
              "; on another computer it is found by [tracker] address");
    const NetworkAddress usual{"127.0.0.1", 4242};
    const auto read = [&](std::string_view text) { return describe(parse_network_address(text, usual)); };
    CHECK(read("[::1") == "[[::1]:4242"); // no bracket ends it
    CHECK(read("[fe80::1]:65535") == "[fe80::1]:65535");
    CHECK(read("host:1") == "host:1");
    CHECK(read("[]:7") == "127.0.0.1:7");
}

TEST_CASE(
    "network cards are listed by their addresses of IPv4, and those without once, the loopback left out",
    "[unit]") {
    std::array<sockaddr_in, 3> addresses{};
    for (std::size_t i = 0; i < 3; ++i) {
        addresses[i].sin_family = AF_INET;
        addresses[i].sin_addr.s_addr = htonl(0x0A000001u + static_cast<std::uint32_t>(i));
    }
    sockaddr_in6 six{};
    six.sin6_family = AF_INET6;
    sockaddr packet{};
    packet.sa_family = AF_PACKET;
    const auto card = [](const char* name, unsigned flags, void* address) {
        ifaddrs entry{};
        entry.ifa_name = const_cast<char*>(name);
        entry.ifa_flags = flags;
        entry.ifa_addr = static_cast<sockaddr*>(address);
        return entry;
    };
    cards_of_test = {card("lo", IFF_LOOPBACK | IFF_UP | IFF_RUNNING, &addresses[0]),
                     card("lo", IFF_LOOPBACK | IFF_UP, &packet),
                     card("eth0", IFF_UP | IFF_RUNNING, &packet),
                     card("eth1", IFF_UP, &packet),
                     card("eth2", 0, nullptr),
                     card("eth2", 0, &six),
                     card("eth0", IFF_UP | IFF_RUNNING, &addresses[1]),
                     card("eth0", IFF_UP, &addresses[2]),
                     card("eth1", IFF_UP, &six),
                     card("eth3", IFF_RUNNING, &addresses[0])};
    std::string all;
    for (const NetworkCard& one : network_cards())
        all += fmt::format("{} {}{}{}; ", one.name, one.address.empty() ? "-" : one.address,
                           one.is_up ? " up" : "", one.has_link ? " linked" : "");
    CHECK(all == "eth0 10.0.0.2 up linked; eth0 10.0.0.3 up; eth3 10.0.0.1 linked; eth1 - up; eth2 -; ");
    CHECK(cards_freed == 1);
    cards_fail = true;
    CHECK(network_cards().empty());
    CHECK(cards_freed == 1);
    cards_fail = false;
    cards_of_test->clear();
    CHECK(network_cards().empty());
    cards_of_test.reset();
}

TEST_CASE("what has come is forgotten in a thousand readings at most", "[unit]") {
    struct Endless final : ByteTransport {
        const std::string& name() const noexcept override { return name_; }
        bool write(std::string_view, SessionTime) noexcept override { return true; }
        std::size_t read(std::span<char> into, SessionTime deadline) noexcept override {
            CHECK(into.size() == 256);
            CHECK(deadline == SessionTime(5s));
            ++readings;
            return readings <= most ? 1 : 0;
        }
        bool lost() const noexcept override { return false; }
        std::string loss() const override { return {}; }
        std::string name_;
        int readings = 0, most = 0;
    };
    for (const int most : {0, 1, 2, 999, 1000, 5000}) {
        Endless line;
        line.most = most;
        read_away(line, SessionTime(5s));
        CHECK(line.readings == std::min(most + 1, 1000));
    }
}

namespace {

/// What connecting ends with, instead of being tried; 0: it is tried.
std::atomic<int> connection_error{0};

struct PipeLine final : DescriptorLine {
    PipeLine(std::string name, const Clock& clock, int descriptor)
        : DescriptorLine(std::move(name), clock, Descriptor(descriptor), "it was closed") {}
};

} // namespace

// It takes the place of the C library's for this program.
extern "C" [[gnu::no_sanitize("thread")]] int connect(int socket, const sockaddr* address, socklen_t size) {
    static auto* const next = next_function<decltype(connect)>("connect");
    if (connection_error == 0)
        return next(socket, address, size);
    errno = connection_error;
    return -1;
}

TEST_CASE("why a server cannot be reached is said with what helps", "[unit]") {
    const SteadyClock clock;
    const auto refused = [&](int error) {
        connection_error = error;
        std::string why;
        try {
            const TcpLine line({"127.0.0.1", 4242}, "tracker", clock, clock.now() + 1s);
        } catch (const DeviceError& failure) {
            why = failure.what();
        }
        connection_error = 0;
        return why;
    };
    const std::string head = "The tracker at 127.0.0.1:4242 cannot be reached: ";
    CHECK(refused(ECONNREFUSED) == head + "Connection refused; nothing listens there: start its program on "
                                          "that machine and switch its server "
                                          "on, or name another address.");
    for (const auto& [error, words] : {std::pair(ETIMEDOUT, "Connection timed out"),
                                       {EHOSTUNREACH, "No route to host"},
                                       {ENETUNREACH, "Network is unreachable"}})
        CHECK(refused(error) == head + words +
                                    "; no answer: check the address, the network cable and the firewall of "
                                    "that machine.");
    CHECK(refused(EACCES) == head + "Permission denied; check the address and the network.");
}

TEST_CASE("a line over a pipe gives its last bytes before it is lost, and says why", "[unit]") {
    const SteadyClock clock;
    int ends[2];
    REQUIRE(pipe2(ends, O_NONBLOCK | O_CLOEXEC) == 0);
    PipeLine line("a pipe", clock, ends[0]);
    CHECK(line.name() == "a pipe");
    std::array<char, 4> some{};
    CHECK(line.read({}, clock.now() + 1s) == 0);
    CHECK(line.read(some, SessionTime()) == 0);
    REQUIRE(write(ends[1], "abcdef", 6) == 6);
    close(ends[1]);
    CHECK(line.read(some, clock.now() + 1s) == 4);
    CHECK(line.read(some, clock.now() + 1s) == 2);
    CHECK_FALSE(line.lost());
    CHECK(line.loss().empty());
    CHECK(line.read(some, clock.now() + 1s) == 0);
    CHECK(line.lost());
    CHECK(line.loss() == "it was closed");
    CHECK_FALSE(line.write("x", clock.now() + 1s));
    // One that cannot be read at all: the system's word.
    int others[2];
    REQUIRE(pipe2(others, O_NONBLOCK | O_CLOEXEC) == 0);
    PipeLine outward("outward", clock, others[1]);
    CHECK(outward.write("hi", clock.now() + 1s));
    char there[3] = {};
    CHECK(read(others[0], there, 2) == 2);
    CHECK(std::string(there) == "hi");
    CHECK(outward.write("", clock.now()));
    // Full: not for ever.
    CHECK_FALSE(outward.write(std::string(1 << 20, 'x'), clock.now() + 20ms));
    CHECK_FALSE(outward.lost());
    Descriptor moved(dup(others[0]));
    const int value = moved.value();
    Descriptor taken(std::move(moved));
    CHECK(taken.value() == value);
    Descriptor other(dup(others[0]));
    const int second = other.value();
    other = std::move(taken);
    CHECK(other.value() == value);
    CHECK(taken.value() == second); // NOLINT(bugprone-use-after-move): they change places
    close(others[0]);
}

namespace {

/// What a host's name stands for, of the test's own.
struct KnownHost {
    explicit KnownHost(const std::vector<std::uint16_t>& ports) : places(ports.size()), all(ports.size()) {
        for (std::size_t i = 0; i < ports.size(); ++i) {
            places[i].sin_family = AF_INET;
            places[i].sin_addr.s_addr = htonl(INADDR_LOOPBACK);
            places[i].sin_port = htons(ports[i]);
            all[i].ai_family = AF_INET;
            all[i].ai_socktype = SOCK_STREAM;
            all[i].ai_addr = reinterpret_cast<sockaddr*>(&places[i]);
            all[i].ai_addrlen = sizeof places[i];
            all[i].ai_next = i + 1 < ports.size() ? &all[i + 1] : nullptr;
        }
        now = this;
    }
    ~KnownHost() { now = nullptr; }
    KnownHost(const KnownHost&) = delete;
    KnownHost& operator=(const KnownHost&) = delete;

    std::vector<sockaddr_in> places;
    std::vector<addrinfo> all;
    std::vector<std::string> asked;
    int freed = 0;
    static inline KnownHost* now = nullptr;
};

} // namespace

extern "C" {
int getaddrinfo(const char* host, const char* port, const addrinfo* wanted, addrinfo** first) {
    if (!KnownHost::now)
        return next_function<decltype(getaddrinfo)>("getaddrinfo")(host, port, wanted, first);
    KnownHost::now->asked.push_back(fmt::format("{} {} {} {}", host, port, wanted->ai_socktype == SOCK_STREAM,
                                                wanted->ai_family == AF_UNSPEC));
    *first = KnownHost::now->all.data();
    return 0;
}
void freeaddrinfo(addrinfo* first) noexcept {
    if (!KnownHost::now)
        return next_function<decltype(freeaddrinfo)>("freeaddrinfo")(first);
    KnownHost::now->freed += first == KnownHost::now->all.data() ? 1 : 100;
}
}

TEST_CASE("all that a host's name stands for is tried, and the first that answers is taken", "[unit]") {
    const SteadyClock clock;
    const TcpPeer peer(echo), other(echo);
    const std::uint16_t none = nobody().port, here = peer.address().port, there = other.address().port;
    for (const auto& ports : {std::vector{here}, {none, here}, {none, none, here, there}}) {
        KnownHost host(ports);
        TcpLine line({"tracker.lab", 4242}, "test server", clock, clock.now() + 20s);
        CHECK(host.asked == std::vector<std::string>{"tracker.lab 4242 true true"});
        CHECK(host.freed == 1);
        CHECK(line.write("x", clock.now() + 20s));
        CHECK(read_all(line, clock, 1) == "x");
    }
    KnownHost host({none, none});
    CHECK_THROWS_WITH(TcpLine({"tracker.lab", 4242}, "test server", clock, clock.now() + 20s),
                      Contains("The test server at tracker.lab:4242 cannot be reached: Connection refused"));
    CHECK(host.freed == 1);
}
