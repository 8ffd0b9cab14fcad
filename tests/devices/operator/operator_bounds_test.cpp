/// How much of each the operator's socket takes and gives, one more than that, and in which words it says so.
#include <atomic>
#include <filesystem>
#include <thread>

#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include "devices/operator/operator_client.h"
#include "devices/operator/operator_server.h"
#include "devices/operator/operator_socket.h"
#include "experiment/base/error.h"
#include "experiment/base/utf8_text.h"
#include "tests/support/next_function.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

struct Served {
    explicit Served(std::size_t ring = 8192) {
        OperatorServer::Options options;
        options.socket = folder.path() / "s";
        options.facts.protocol = "small";
        options.ring_capacity = ring;
        options.tell = [this](const std::string& words) {
            const std::lock_guard lock(mutex);
            told.push_back(words);
        };
        server.emplace(std::move(options));
    }
    /// The words that the server tells, once there are so many.
    std::vector<std::string> words(std::size_t count) {
        for (int tries = 0; tries < 1000; ++tries) {
            {
                const std::lock_guard lock(mutex);
                if (told.size() >= count)
                    return told;
            }
            std::this_thread::sleep_for(5ms);
        }
        return told;
    }
    void push_event(const std::string& text) {
        ViewNews news;
        news.set_word("mark");
        news.set_text(text);
        server->push(news);
    }

    TemporaryFolder folder;
    std::mutex mutex;
    std::vector<std::string> told;
    std::optional<OperatorServer> server;
};

/// A connection without a language.
struct Raw {
    explicit Raw(const Served& served) : socket(connect_to(SocketAddress(served.folder.path() / "s"))) {
        REQUIRE(socket >= 0);
    }
    ~Raw() { ::close(socket); }
    void send(const std::string& text) const {
        REQUIRE(::send(socket, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size()));
    }
    /// Reads for so long; false once it was cut off.
    bool read(std::chrono::milliseconds time) {
        const auto until = std::chrono::steady_clock::now() + time;
        std::array<char, 4096> bytes{};
        do {
            const ssize_t count = ::recv(socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
            if (count == 0 || (count < 0 && errno != EAGAIN))
                return false;
            if (count > 0)
                received.append(bytes.data(), static_cast<std::size_t>(count));
            else
                std::this_thread::sleep_for(2ms);
        } while (std::chrono::steady_clock::now() < until);
        return true;
    }
    std::size_t lines() const { return static_cast<std::size_t>(std::ranges::count(received, '\n')); }
    int socket;
    std::string received;
};

std::string padded(std::string line, std::size_t size) {
    line.insert(1, std::string(size - line.size(), ' '));
    return line + "\n";
}

} // namespace

TEST_CASE(
    "a view that comes late is told the last hundred events, and of no trial what it was not told in one",
    "[unit]") {
    Served served;
    for (int i = 0; i < 130; ++i)
        served.push_event(fmt::format("event {}", i));
    OperatorClient first(served.folder.path() / "s");
    std::vector<std::string> heard;
    for (int tries = 0; tries < 500 && (heard.empty() || heard.back() != "event 129"); ++tries) {
        first.read(10ms);
        for (const ViewedEvent& event : first.take_events())
            heard.push_back(event.detail);
    }
    // It may have come while some of them were still on their way.
    OperatorClient late(served.folder.path() / "s");
    heard.clear();
    for (int tries = 0; tries < 500 && (heard.empty() || heard.back() != "event 129"); ++tries) {
        late.read(10ms);
        for (const ViewedEvent& event : late.take_events())
            heard.push_back(event.detail);
    }
    REQUIRE(heard.size() == 100);
    CHECK(heard.front() == "event 30");
    // Sixty-four commands wait; what comes beyond is refused in words.
    for (int i = 0; i < 70; ++i)
        REQUIRE(late.send(operator_command("note x").value()));
    std::vector<ViewedEvent> refused;
    for (int tries = 0; tries < 500 && refused.size() < 6; ++tries) {
        late.read(10ms);
        for (const ViewedEvent& event : late.take_events())
            refused.push_back(event);
    }
    REQUIRE(refused.size() == 6);
    for (const ViewedEvent& event : refused) {
        CHECK(event.trial == -1);
        CHECK(event.kind == "operator's view");
        CHECK(event.detail == "note x: was not taken: too many commands wait");
    }
    OperatorCommand command;
    int taken = 0;
    while (served.server->next_command(command))
        ++taken;
    CHECK(taken == 64);
}

TEST_CASE("four views are served, the fifth is turned away, and who has not greeted makes room", "[unit]") {
    Served served;
    std::vector<std::unique_ptr<OperatorClient>> views;
    for (int i = 0; i < 4; ++i)
        views.push_back(std::make_unique<OperatorClient>(served.folder.path() / "s"));
    for (const auto& view : views)
        CHECK(view->read(100ms));
    Raw fifth(served);
    CHECK_FALSE(fifth.read(5s));
    CHECK(fifth.received.empty());
    CHECK(served.words(1) ==
          std::vector<std::string>{"operator's view: 4 are open, and another was turned away"});
    for (const auto& view : views)
        CHECK(view->read(0ms));
    views.pop_back();
    Raw silent(served);
    silent.read(100ms);
    const OperatorClient next(served.folder.path() / "s"); // in the place of the silent one
    CHECK_FALSE(silent.read(5s));
}

TEST_CASE(
    "a command line holds 1024 bytes, and what is more, no command or another language is cut off in words",
    "[unit]") {
    Served served;
    {
        Raw view(served);
        view.send(line_of_greeting() + padded("{\"command\":\"pause\"}", longest_command_line));
        CHECK(view.read(100ms));
        OperatorCommand command;
        bool has_come = false;
        for (int tries = 0; tries < 500 && !has_come; ++tries) {
            has_come = served.server->next_command(command);
            std::this_thread::sleep_for(2ms);
        }
        CHECK(has_come);
        CHECK(command.key == ResponsePress::Key::pause);
        view.send(padded("{\"command\":\"pause\"}", longest_command_line + 1));
        CHECK_FALSE(view.read(5s));
    }
    const auto cut_off = [](const std::string& why) {
        return "operator's view: a program " + why + ": it was cut off, and the session goes on";
    };
    {
        Raw view(served);
        view.send(line_of_greeting());
        view.send(std::string(longest_command_line, 'x')); // may still end
        CHECK(view.read(100ms));
        view.send("y");
        CHECK_FALSE(view.read(5s));
    }
    {
        Raw view(served);
        view.send(fmt::format("{{\"overt_watch\":{}}}\n", view_version + 1));
        CHECK_FALSE(view.read(5s));
    }
    {
        Raw view(served);
        view.send(std::string(80, 'z') + "\n");
        CHECK_FALSE(view.read(5s));
    }
    const std::vector<std::string> words = served.words(4);
    REQUIRE(words.size() == 4);
    CHECK_THAT(words[0], Catch::Contains("which is no command"));
    CHECK(words[1] == cut_off("sent a line without an end"));
    CHECK(words[2] == cut_off(fmt::format("speaks version {} of the language, this session version {}",
                                          view_version + 1, view_version)));
    CHECK(words[3] == cut_off("sent \"" + std::string(60, 'z') + "\", which is no command"));
}

TEST_CASE("where nothing is new a view is told the state now and then, and one that has not greeted nothing",
          "[unit]") {
    Served served;
    const auto began = std::chrono::steady_clock::now();
    Raw silent(served), greeted(served);
    greeted.send(line_of_greeting());
    greeted.read(400ms);
    CameraImage image{192, 144, std::vector<std::byte>(4 * 192 * 144), "left"};
    served.server->show_camera(image);
    greeted.read(200ms);
    silent.read(1ms);
    CHECK(silent.lines() == 1); // what does not change
    CHECK(greeted.lines() >= 3);
    // That, the state once and each half second, and the image.
    const auto half_seconds = (std::chrono::steady_clock::now() - began) / 500ms;
    CHECK(greeted.lines() <= 4 + static_cast<std::size_t>(half_seconds));
}

TEST_CASE("a camera's image is sent whole up to its largest size, and beyond with every second pixel",
          "[unit]") {
    Served served;
    OperatorClient client(served.folder.path() / "s");
    const auto seen = [&](int width, int height) {
        CameraImage image{width, height, {}, "eye"};
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                image.rgba.insert(image.rgba.end(), {std::byte(x), std::byte(y), std::byte(3), std::byte(4)});
        for (int tries = 0; tries < 500; ++tries) {
            served.server->show_camera(image);
            client.read(10ms);
            if (std::optional<ViewedCamera> camera = client.take_camera();
                camera && camera->title == "eye" &&
                (camera->rgb.size() == 3u * static_cast<std::size_t>(camera->width_px * camera->height_px)))
                return *camera;
        }
        return ViewedCamera{};
    };
    ViewedCamera camera = seen(192, 144);
    CHECK((camera.width_px == 192 && camera.height_px == 144));
    CHECK((camera.rgb[3 * 191] == std::byte(191) && camera.rgb[3 * 192 + 1] == std::byte(1)));
    for (int tries = 0; tries < 50 && camera.width_px != 97; ++tries)
        camera = seen(193, 144);
    CHECK((camera.width_px == 97 && camera.height_px == 72));
    CHECK((camera.rgb[3] == std::byte(2) && camera.rgb[3 * 97 + 1] == std::byte(2)));
    for (int tries = 0; tries < 50 && camera.height_px != 73; ++tries)
        camera = seen(10, 145);
    CHECK((camera.width_px == 5 && camera.height_px == 73));
    for (int tries = 0; tries < 50 && camera.width_px != 1; ++tries)
        camera = seen(1, 1);
    CHECK((camera.width_px == 1 && camera.height_px == 1));
}

TEST_CASE("what a server opens for its views, those that it turns away and those that fail, it closes",
          "[unit]") {
    const auto open_descriptors = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                             std::filesystem::directory_iterator());
    };
    const auto before = open_descriptors();
    {
        Served served;
        std::vector<std::unique_ptr<OperatorClient>> views;
        for (int i = 0; i < 4; ++i)
            views.push_back(std::make_unique<OperatorClient>(served.folder.path() / "s"));
        {
            Raw fifth(served);
            CHECK_FALSE(fifth.read(5s));
        }
        views.pop_back();
        {
            Raw cut(served);
            cut.send("no greeting\n");
            CHECK_FALSE(cut.read(5s));
        }
        {
            Raw silent(served);
            silent.read(50ms);
            const OperatorClient instead(served.folder.path() / "s");
            CHECK_FALSE(silent.read(5s));
        }
        CHECK(is_served(served.folder.path() / "s"));
        // A second server at the same place, which closes what it had opened.
        OperatorServer::Options options;
        options.socket = served.folder.path() / "s";
        CHECK_THROWS_AS(OperatorServer(std::move(options)), InputError);
        served.server.reset(); // while three views are open
        for (const auto& view : views)
            for (int i = 0; i < 100 && view->read(20ms); ++i) {
            }
        CHECK_THROWS_AS(OperatorClient(served.folder.path() / "s"), InputError);
        CHECK_FALSE(is_served(served.folder.path() / "s"));
        CHECK(std::filesystem::is_empty(served.folder.path()));
    }
    CHECK(open_descriptors() == before);
    const TemporaryFolder folder;
    for (const std::filesystem::path& place :
         {folder.path() / "none" / "s", folder.path() / "", folder.path() / std::string(200, 'x')}) {
        CHECK_THROWS_AS(check_socket_place(place), Error);
        CHECK_THROWS_AS(OperatorClient(place), Error);
    }
    OperatorServer::Options options;
    options.socket = folder.path() / "none" / "s";
    CHECK_THROWS_AS(OperatorServer(std::move(options)), Error);
    CHECK(open_descriptors() == before);
}

TEST_CASE("what a program sent that is no command is told from its first letter on, sixty of them",
          "[unit]") {
    Served served;
    for (const std::string& text :
         {std::string("stop!"), std::string(60, 'a') + "b", std::string("\xff\x01x")}) {
        const std::size_t before = served.words(0).size();
        Raw raw(served);
        raw.send(line_of_greeting() + text + "\n");
        CHECK_FALSE(raw.read(5s));
        const auto words = served.words(before + 1);
        REQUIRE(words.size() == before + 1);
        const std::string said = text[0] == '\xff' ? ascii_of(text) : text.substr(0, 60);
        CHECK(words.back() == "operator's view: a program sent \"" + said +
                                  "\", which is no command: it was cut off, and the session goes on");
    }
}

namespace {

/// The user of the program at the other end of a socket, instead of the true one; -1: that one.
std::atomic<std::int64_t> peer_user{-1};

} // namespace

// It takes the place of the C library's for this program.
extern "C" [[gnu::no_sanitize("thread")]] int getsockopt(int socket, int level, int option, void* value,
                                                         socklen_t* size) noexcept {
    static auto* const next = next_function<decltype(getsockopt)>("getsockopt");
    const int result = next(socket, level, option, value, size);
    if (peer_user >= 0 && level == SOL_SOCKET && option == SO_PEERCRED)
        static_cast<ucred*>(value)->uid = static_cast<uid_t>(peer_user);
    return result;
}

TEST_CASE("views of this user and of the system's are served, and those of others turned away", "[unit]") {
    Served served;
    const uid_t own = ::geteuid();
    for (const uid_t user : {own, uid_t{0}}) {
        peer_user = user;
        OperatorClient view(served.folder.path() / "s");
        CHECK(view.read(50ms));
    }
    for (const uid_t user : {own + 1, own + 1000}) {
        peer_user = user;
        const std::size_t before = served.words(0).size();
        Raw other(served);
        CHECK_FALSE(other.read(5s));
        CHECK(other.received.empty());
        CHECK(served.words(before + 1).back() ==
              "operator's view: a program of another user was turned away");
    }
    peer_user = -1;
    // An image without a pixel is none.
    OperatorClient view(served.folder.path() / "s");
    for (int tries = 0; tries < 100 && view.read(10ms) && tries < 20; ++tries) {
    }
    CameraImage image;
    for (const auto& [width, height] : {std::pair(0, 2), {2, 0}}) {
        image.width_px = width;
        image.height_px = height;
        image.rgba.assign(64, std::byte{9});
        served.server->show_camera(image);
    }
    for (int tries = 0; tries < 10; ++tries)
        view.read(10ms);
    CHECK_FALSE(view.take_camera());
    image.width_px = image.height_px = 1;
    served.server->show_camera(image);
    std::optional<ViewedCamera> shown;
    for (int tries = 0; tries < 300 && !(shown = view.take_camera()); ++tries)
        view.read(10ms);
    REQUIRE(shown);
    CHECK(shown->width_px == 1);
}

TEST_CASE("a session that speaks another version is told apart, and one that never answers, too", "[unit]") {
    const TemporaryFolder folder;
    const SocketAddress address(folder.path() / "s");
    const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    REQUIRE(::bind(listener, address.address(), address.size()) == 0);
    REQUIRE(::listen(listener, 4) == 0);
    bool is_sent = false;
    std::jthread session([&] {
        const int view = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
        const std::string line = fmt::format("{{\"overt_watch\":{}}}\n", view_version + 1);
        is_sent = ::send(view, line.data(), line.size(), MSG_NOSIGNAL) > 0;
        char byte = 0;
        while (::recv(view, &byte, 1, 0) > 0) {
        }
        ::close(view);
    });
    CHECK_THROWS_WITH(
        OperatorClient(folder.path() / "s"),
        Catch::Contains(fmt::format("the session speaks version {} of the operator's language, this "
                                    "program version {}: use the overt",
                                    view_version + 1, view_version)));
    session = {};
    CHECK(is_sent);
    ::close(listener);
}

TEST_CASE("a socket's own name has 82 bytes at most, so that whoever looks for it can reach it", "[unit]") {
    const TemporaryFolder folder;
    const auto named = [&](std::size_t bytes) { return folder.path() / std::string(bytes, 's'); };
    const auto serve = [](const std::filesystem::path& socket) {
        OperatorServer::Options options;
        options.socket = socket;
        options.facts.protocol = "small";
        return std::make_unique<OperatorServer>(std::move(options));
    };
    {
        const auto server = serve(named(82));
        CHECK(is_served(named(82)));
        CHECK(OperatorClient(named(82)).facts().protocol == "small");
    }
    for (const std::size_t bytes : {83u, 107u, 200u}) {
        const std::string words = "no socket can be called so: give it a shorter name, of 82 bytes at most";
        CHECK_THROWS_WITH(serve(named(bytes)), Catch::EndsWith(words));
        CHECK_THROWS_WITH(check_socket_place(named(bytes)), Catch::EndsWith(words));
        CHECK_THROWS_WITH(OperatorClient(named(bytes)), Catch::EndsWith(words));
        CHECK_THROWS_AS(serve(named(bytes)), InputError);
    }
    CHECK_THROWS_AS(check_socket_place(folder.path() / ""), InputError);
    CHECK(std::filesystem::is_empty(folder.path()));
    // The longest that "/proc/self/fd/" and any descriptor's number leave of a socket's address.
    CHECK(std::string("/proc/self/fd/2147483647/").size() + 82 + 1 == sizeof(sockaddr_un::sun_path));
}

TEST_CASE("who sends more than the longest line without an end is no session", "[unit]") {
    for (const std::size_t more : {0u, 1u}) {
        const TemporaryFolder folder;
        const SocketAddress address(folder.path() / "s");
        const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        REQUIRE(::bind(listener, address.address(), address.size()) == 0);
        REQUIRE(::listen(listener, 1) == 0);
        std::jthread sender([&] {
            const int view = ::accept(listener, nullptr, nullptr);
            char greeting[256];
            static_cast<void>(::recv(view, greeting, sizeof greeting, 0));
            const std::string line(longest_camera_line + more, 'x');
            static_cast<void>(::send(view, line.data(), line.size(), MSG_NOSIGNAL));
            ::close(view);
        });
        CHECK_THROWS_WITH(OperatorClient(folder.path() / "s"),
                          Catch::EndsWith(more == 0 ? ": the session does not answer"
                                                    : "the session sent a line without an end: this is no "
                                                      "operator's socket of overt"));
        sender.join();
        ::close(listener);
    }
}

TEST_CASE("commands wait for a session that reads late, and are given up where it never does", "[unit]") {
    for (const bool reads : {true, false}) {
        const TemporaryFolder folder;
        const SocketAddress address(folder.path() / "s");
        const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        REQUIRE(::bind(listener, address.address(), address.size()) == 0);
        REQUIRE(::listen(listener, 1) == 0);
        std::atomic<bool> is_over{false};
        std::string heard;
        bool is_greeted = false;
        std::jthread session([&] {
            const int view = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
            const std::string facts = line_of(SessionFacts{});
            is_greeted = ::send(view, facts.data(), facts.size(), MSG_NOSIGNAL) > 0;
            std::this_thread::sleep_for(100ms);
            std::array<char, 65536> bytes;
            for (ssize_t count = 1; reads && count > 0;) {
                count = ::recv(view, bytes.data(), bytes.size(), 0);
                heard.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
            }
            while (!is_over)
                std::this_thread::sleep_for(1ms);
            ::close(view);
        });
        std::string sent = line_of_greeting();
        {
            OperatorClient client(folder.path() / "s");
            constexpr int most = 12'000; // more than a socket holds
            int taken = 0;
            for (; taken < most; ++taken) {
                const OperatorCommand note =
                    operator_command(fmt::format("note {} {}", taken, std::string(60, 'x'))).value();
                if (!client.send(note))
                    break;
                sent += line_of(note);
            }
            CHECK((taken == most) == reads);
            if (!reads) // once given up, it stays so
                CHECK_FALSE(client.send(operator_command("pause").value()));
        }
        is_over = true;
        session.join();
        CHECK(is_greeted);
        if (reads)
            CHECK(heard == sent);
        ::close(listener);
    }
}

TEST_CASE(
    "a view keeps the last thousand events that nobody took, and is told all that was pushed before the end",
    "[unit]") {
    Served served;
    OperatorClient client(served.folder.path() / "s");
    client.read(50ms);
    constexpr int pushed = 1003;
    for (int i = 0; i < pushed; ++i) {
        served.push_event(fmt::format("event {}", i));
        if (i % 50 == 0)
            client.read(20ms);
    }
    served.server.reset(); // with what it has not sent yet
    for (int tries = 0; tries < 500 && client.read(10ms); ++tries) {
    }
    const auto events = client.take_events();
    REQUIRE(events.size() == 1000);
    for (std::size_t i = 0; i < events.size(); ++i)
        REQUIRE(events[i].detail == fmt::format("event {}", i + 3));
    CHECK(client.take_events().empty());
}
