/// The socket of the operator's view, and the panel behind it.
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include "devices/operator/gaze_tap.h"
#include "devices/operator/operator_client.h"
#include "devices/operator/operator_panel.h"
#include "devices/operator/operator_server.h"
#include "devices/operator/operator_socket.h"
#include "experiment/base/error.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/session_log.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

using namespace std::chrono_literals;

class StandingClock final : public Clock {
  public:
    SessionTime now() const noexcept override { return {}; }
    void wait_until(SessionTime) noexcept override {}
};

/// Presses nothing.
class SilentPanel final : public ResponsePanel {
  public:
    void await(Awaited, SessionTime, const Trial*) override {}
    std::optional<ResponsePress> poll() noexcept override { return std::nullopt; }
    std::string answer() override { return {}; }
};

OperatorServer::Options options_at(const std::filesystem::path& socket) {
    OperatorServer::Options options;
    options.socket = socket;
    options.facts.protocol = "small";
    options.facts.trials = 10;
    return options;
}

ViewNews numbered(std::int64_t samples) {
    ViewNews news;
    news.kind = ViewNews::Kind::samples;
    news.samples = samples;
    return news;
}

/// Counts what the panel writes down.
class NotedEvents final : public SessionLog {
  public:
    int notes = 0, others = 0;
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent& event) override { ++(event.kind == operator_note_event ? notes : others); }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
};

/// Until the press comes, which another thread brings.
std::optional<ResponsePress> awaited_press(OperatorPanel& panel) {
    for (int tries = 0; tries < 5000; ++tries) {
        if (const auto press = panel.poll())
            return press;
        std::this_thread::sleep_for(2ms);
    }
    return std::nullopt;
}

/// Reads until the newest event says this; false if it never does.
bool comes_to_say(OperatorClient& client, std::string_view words) {
    for (int tries = 0; tries < 500; ++tries) {
        client.read(20ms);
        for (const ViewedEvent& event : client.take_events())
            if (event.detail.find(words) != std::string::npos)
                return true;
    }
    return false;
}

} // namespace

TEST_CASE("pushing never waits: what a ring has no room for is dropped and counted", "[unit]") {
    const TemporaryFolder folder;
    OperatorServer::Options options = options_at(folder.path() / "view.sock");
    options.ring_capacity = 4;
    OperatorServer server(std::move(options));
    constexpr std::int64_t pushed = 100'000;
    for (std::int64_t i = 1; i <= pushed; ++i)
        server.push(numbered(i));
    CHECK(server.dropped() > 0);
    CHECK(server.dropped() < pushed);
    OperatorClient client(folder.path() / "view.sock");
    // A counter in news that came is right, whatever was dropped before it.
    std::this_thread::sleep_for(50ms);
    server.push(numbered(pushed + 1));
    while (client.view().samples <= pushed)
        client.read(20ms);
    CHECK(client.view().samples == pushed + 1);
    CHECK(client.view().dropped == server.dropped());
}

TEST_CASE("a view that comes late is told what was, and one that does not read holds up nobody", "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    ViewNews event;
    event.set_word("operator's note");
    event.set_text("before it came");
    server.push(event);
    OperatorClient stalled(folder.path() / "view.sock"); // greets, and reads nothing after that
    OperatorClient client(folder.path() / "view.sock");
    CHECK(comes_to_say(client, "before it came"));
    event.set_text(std::string(240, 'x'));
    for (int i = 0; i < 20'000; ++i) {
        server.push(event);
        if (i % 2000 == 0)
            client.read(5ms);
    }
    event.set_text("the last");
    // Room for it, once the thread has emptied the ring.
    bool is_heard = false;
    for (int tries = 0; tries < 100 && !is_heard; ++tries) {
        server.push(event);
        client.read(20ms);
        for (const ViewedEvent& one : client.take_events())
            is_heard = is_heard || one.detail == "the last";
    }
    CHECK(is_heard);
    // It is told how much it missed as soon as it reads.
    CHECK(comes_to_say(stalled, "were left out here"));
}

TEST_CASE("a socket is replaced where nobody serves it, and left alone where somebody does", "[unit]") {
    const TemporaryFolder folder;
    // Deep enough that the system would not take its path.
    const std::filesystem::path deep = folder.path() / std::string(120, 'd');
    std::filesystem::create_directories(deep);
    const std::filesystem::path socket = deep / "view.sock";
    {
        const SocketAddress address(socket);
        const int left_over = ::socket(AF_UNIX, SOCK_STREAM, 0);
        REQUIRE(::bind(left_over, address.address(), address.size()) == 0);
        ::close(left_over);
    }
    CHECK(!is_served(socket));
    {
        const OperatorServer server(options_at(socket));
        CHECK(is_served(socket));
        CHECK_THROWS_WITH(OperatorServer(options_at(socket)),
                          Catch::Contains("another session serves this socket"));
    }
    CHECK(!std::filesystem::exists(socket));
    folder.file("file", "words");
    CHECK_THROWS_WITH(OperatorServer(options_at(folder.path() / "file")), Catch::Contains("no socket"));
    CHECK(std::filesystem::exists(folder.path() / "file"));
    CHECK_THROWS_AS(OperatorClient(folder.path() / "none"), InputError);
    CHECK_THROWS_AS(check_socket_place(folder.path() / "none" / "view.sock"), InputError);
}

TEST_CASE("a command is a key, and answers only the question that the session asks about it", "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    StandingClock clock;
    SilentPanel silent;
    OperatorPanel panel(server, clock, silent);
    OperatorClient client(folder.path() / "view.sock");
    using Key = ResponsePress::Key;
    panel.entered(SessionPhase::stimulus, 2);

    client.send(operator_command("skip 2").value());
    client.send(operator_command("pause").value());
    auto press = awaited_press(panel);
    REQUIRE(press);
    CHECK(press->key == Key::skip);
    // The tracker was lost meanwhile: that question is not answered by the command.
    panel.await_decision(false, {});
    std::this_thread::sleep_for(100ms);
    CHECK(!panel.poll());
    client.send(operator_command("yes").value());
    press = awaited_press(panel);
    REQUIRE(press);
    CHECK(press->key == Key::yes);
    // Now the session comes to the key.
    panel.acted_on("skip");
    panel.await_decision(false, {});
    press = panel.poll();
    REQUIRE(press);
    CHECK(press->key == Key::character);
    CHECK(press->character == U'2');
    // The command after it had to wait.
    panel.await_key({});
    press = awaited_press(panel);
    REQUIRE(press);
    CHECK(press->key == Key::pause);

    panel.entered(SessionPhase::pause, 2);
    client.send(operator_command("repeat").value());
    CHECK(!panel.poll());
    for (int tries = 0; tries < 100; ++tries) {
        CHECK(!panel.poll());
        std::this_thread::sleep_for(2ms);
    }
    CHECK(comes_to_say(client, "no trial is under way"));
    client.send(operator_command("note all is well").value());
    bool is_of_trial = false;
    for (int tries = 0; tries < 500 && !is_of_trial; ++tries) {
        CHECK(!panel.poll());
        client.read(10ms);
        for (const ViewedEvent& event : client.take_events())
            is_of_trial =
                is_of_trial || (event.detail == "the note goes into the record" && event.trial == 2);
    }
    CHECK(is_of_trial);
}

TEST_CASE("the command that ends the session does not wait for the one before it", "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    StandingClock clock;
    SilentPanel silent;
    OperatorPanel panel(server, clock, silent);
    OperatorClient client(folder.path() / "view.sock");
    panel.entered(SessionPhase::stimulus, 0);
    client.send(operator_command("reject").value());
    client.send(operator_command("repeat").value());
    client.send(operator_command("abort").value());
    CHECK(awaited_press(panel).value().key == ResponsePress::Key::reject);
    CHECK(awaited_press(panel).value().key == ResponsePress::Key::abort);
    panel.acted_on("abort");
    panel.await_decision(false, {});
    CHECK(panel.poll().value().key == ResponsePress::Key::yes);
}

TEST_CASE("who sends what is no command, no greeting or another version is cut off", "[unit]") {
    const TemporaryFolder folder;
    const OperatorServer server(options_at(folder.path() / "view.sock"));
    for (const std::string& sent :
         {std::string("GET / HTTP/1.1\r\n\r\n"), std::string("{\"command\":\"abort\"}\n"),
          std::string("{\"overt_watch\":99}\n"), line_of_greeting() + "{\"command\":\"stop\"}\n",
          std::string(5000, '\xff')}) {
        const int garbage = connect_to(SocketAddress(folder.path() / "view.sock"));
        REQUIRE(garbage >= 0);
        REQUIRE(::send(garbage, sent.data(), sent.size(), MSG_NOSIGNAL) > 0);
        char bytes[4096];
        ssize_t count = -1;
        // What it was told before may still come; then the end of the connection.
        for (int tries = 0; tries < 1000 && count != 0 && !(count < 0 && errno == ECONNRESET); ++tries) {
            count = ::recv(garbage, bytes, sizeof bytes, MSG_DONTWAIT);
            if (count < 0 && errno == EAGAIN)
                std::this_thread::sleep_for(5ms);
        }
        INFO(sent.substr(0, 40));
        CHECK((count == 0 || (count < 0 && errno == ECONNRESET)));
        ::close(garbage);
    }
}

TEST_CASE("gaze is told every 4 ms for each eye, with the trial's state before it", "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    const StandingClock clock;
    GazeTap tap(server, clock);
    OperatorClient client(folder.path() / "view.sock");
    ViewNews phase;
    phase.kind = ViewNews::Kind::phase;
    phase.phase = SessionPhase::stimulus;
    phase.trial = 2;
    server.push(phase);
    // A sample of each eye every 0.5 ms, and the tracker's clock set back in between.
    for (int i = 0; i < 80; ++i)
        for (const Eye eye : {Eye::left, Eye::right})
            tap.measured({tracker_time((i < 40 ? 90'000 : 10'000) + 500 * i), eye,
                          i == 8 ? std::nullopt : std::optional(ScreenPoint{1.0 * i, 0.0}), 1.0f});
    std::vector<ViewedGaze> all;
    while (all.size() < 20) {
        REQUIRE(client.read(2000ms));
        for (const ViewedGaze& one : client.take_gaze()) {
            CHECK(client.view().trial == 2);
            all.push_back(one);
        }
    }
    REQUIRE(all.size() == 20);
    for (std::size_t i = 0; i < 20; ++i) {
        CHECK(all[i].is_right == (i % 2 == 1));
        CHECK(all[i].trial == 2);
        const std::size_t pair = i / 2;
        if (pair == 1)
            CHECK(!all[i].place);
        else
            CHECK(all[i].place.value().x_px == 8.0 * static_cast<double>(pair));
    }
    CHECK(server.dropped() == 0);
}

TEST_CASE("a camera's image comes to the views small, with its colours, ten times a second at most",
          "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    CameraImage image{400, 200, {}, "left eye"};
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 400; ++x)
            image.rgba.insert(image.rgba.end(),
                              {std::byte(x % 256), std::byte(y), std::byte(7), std::byte(9)});
    server.show_camera(image); // nobody watches
    OperatorClient client(folder.path() / "view.sock");
    std::optional<ViewedCamera> camera;
    int sent = 0, came = 0;
    const auto began = std::chrono::steady_clock::now();
    while (came < 3) {
        server.show_camera(image);
        ++sent;
        client.read(5ms);
        if (std::optional<ViewedCamera> one = client.take_camera()) {
            camera = std::move(one);
            ++came;
        }
        REQUIRE(sent < 100'000);
    }
    CHECK(std::chrono::steady_clock::now() - began >= 200ms);
    REQUIRE(camera->width_px == 134);
    REQUIRE(camera->height_px == 67);
    CHECK(camera->title == "left eye");
    // Every third pixel in both directions.
    const std::size_t at = 3 * (10 * 134 + 20);
    CHECK(camera->rgb[at] == std::byte(60));
    CHECK(camera->rgb[at + 1] == std::byte(30));
    CHECK(camera->rgb[at + 2] == std::byte(7));
}

TEST_CASE("a view of a session that is over waits as it is asked to, and keeps what it has", "[unit]") {
    const TemporaryFolder folder;
    std::optional<OperatorServer> server(options_at(folder.path() / "view.sock"));
    OperatorClient client(folder.path() / "view.sock");
    server.reset();
    while (client.read(20ms)) {
    }
    CHECK(client.view().is_over);
    const auto began = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i)
        CHECK(!client.read(10ms));
    CHECK(std::chrono::steady_clock::now() - began >= 90ms);
    CHECK(client.view().is_over);
    CHECK(client.facts().protocol == "small");
}

TEST_CASE("nothing that is no socket of the server's is removed or replaced, nor a socket that is busy",
          "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path socket = folder.path() / "view.sock";
    folder.file("view.sock.new", "somebody's");
    {
        const OperatorServer server(options_at(socket));
        CHECK(std::filesystem::exists(folder.path() / "view.sock.new"));
        // Somebody puts a file of that name there while the session runs.
        std::filesystem::remove(socket);
        folder.file("view.sock", "words");
    }
    CHECK(std::filesystem::exists(socket));
    CHECK(std::filesystem::exists(folder.path() / "view.sock.new"));

    const std::filesystem::path busy = folder.path() / "busy.sock";
    const SocketAddress address(busy);
    const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
    REQUIRE(::bind(listener, address.address(), address.size()) == 0);
    REQUIRE(::listen(listener, 0) == 0);
    std::vector<int> waiting;
    for (int one = 0; (one = connect_to(address)) >= 0;)
        waiting.push_back(one);
    CHECK(is_served(busy));
    CHECK_THROWS_WITH(OperatorServer(options_at(busy)),
                      Catch::Contains("another session serves this socket"));
    for (const int one : waiting)
        ::close(one);
    ::close(listener);
}

TEST_CASE("programs that connect and never greet keep no view out", "[unit]") {
    const TemporaryFolder folder;
    const OperatorServer server(options_at(folder.path() / "view.sock"));
    std::vector<int> silent;
    for (int i = 0; i < 12; ++i)
        silent.push_back(connect_to(SocketAddress(folder.path() / "view.sock")));
    std::this_thread::sleep_for(100ms);
    const OperatorClient client(folder.path() / "view.sock");
    CHECK(client.facts().protocol == "small");
    for (const int one : silent)
        ::close(one);
}

TEST_CASE("each note that is acknowledged is recorded, and one that finds no room is refused", "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    StandingClock clock;
    SilentPanel silent;
    OperatorPanel panel(server, clock, silent);
    OperatorClient client(folder.path() / "view.sock");
    panel.entered(SessionPhase::stimulus, 2);
    constexpr int sent = 90;
    int acknowledged = 0, refused = 0;
    for (int i = 0; i < sent; ++i)
        client.send(operator_command(fmt::format("note number {}", i)).value());
    for (int tries = 0; tries < 2000 && acknowledged + refused < sent; ++tries) {
        CHECK(!panel.poll());
        client.read(5ms);
        for (const ViewedEvent& event : client.take_events()) {
            acknowledged += event.detail.find("goes into the record") != std::string::npos;
            refused += event.detail.find("was not taken") != std::string::npos;
        }
    }
    CHECK(acknowledged + refused == sent);
    CHECK(acknowledged > 32);
    CHECK(refused > 0);
    // A key still finds room, and is recorded, too.
    client.send(operator_command("pause").value());
    CHECK(awaited_press(panel).value().key == ResponsePress::Key::pause);
    NotedEvents log;
    panel.write_down(log);
    CHECK(log.notes == acknowledged);
    CHECK(log.others == 1);
}

TEST_CASE("forty-eight notes wait for a trial's end, sixty keys, and answers and the end of a session always",
          "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    StandingClock clock;
    SilentPanel silent;
    OperatorPanel panel(server, clock, silent);
    OperatorClient client(folder.path() / "view.sock");
    panel.entered(SessionPhase::stimulus, 2);
    int told = 0, refused = 0;
    const auto send = [&](const std::string& words) {
        const int before = told;
        client.send(operator_command(words).value());
        bool is_pressed = false;
        for (int tries = 0; tries < 2000 && told == before; ++tries) {
            is_pressed = panel.poll().has_value() || is_pressed;
            client.read(1ms);
            for (const ViewedEvent& event : client.take_events()) {
                ++told;
                refused += event.detail.find("was not taken") != std::string::npos;
            }
        }
        return is_pressed;
    };
    for (int i = 0; i < 50; ++i) {
        send(fmt::format("note number {}", i));
        CHECK(refused == std::max(0, i - 47));
    }
    for (int i = 0; i < 14; ++i) {
        const bool is_taken = send("pause"); // 49 to 60
        CHECK(is_taken == (i < 12));
    }
    CHECK(refused == 4);
    CHECK(send("abort"));
    NotedEvents log;
    panel.write_down(log);
    CHECK(log.notes == 48);
    CHECK(log.others == 13);
    send("note after it");
    panel.write_down(log);
    CHECK(log.notes == 49);
}

TEST_CASE(
    "a question is answered by its command once, with yes where no reason was given, and after another key "
    "by nobody",
    "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    StandingClock clock;
    SilentPanel silent;
    OperatorPanel panel(server, clock, silent);
    OperatorClient client(folder.path() / "view.sock");
    using Key = ResponsePress::Key;
    panel.entered(SessionPhase::stimulus, 2);
    const auto press = [&](const char* words) {
        client.send(operator_command(words).value());
        return awaited_press(panel).value();
    };
    CHECK(press("skip").key == Key::skip);
    panel.acted_on("reject"); // another key
    panel.await_decision(false, SessionTime(1s));
    CHECK_FALSE(panel.poll());
    panel.acted_on("skip");
    panel.await_decision(false, SessionTime(2s));
    const ResponsePress yes = panel.poll().value();
    CHECK(yes.key == Key::yes);
    CHECK(yes.pressed_at == SessionTime(2s));
    // The next question is not answered by it, whether it is this key's or not.
    panel.await_decision(false, SessionTime(3s));
    CHECK_FALSE(panel.poll());
    CHECK(press("no").key == Key::no);
    panel.acted_on("skip");
    panel.await_decision(false, SessionTime(4s));
    CHECK_FALSE(panel.poll());
    // An answer that was not asked for any more is forgotten.
    panel.await_key({});
    CHECK(press("repeat").key == Key::repeat);
    panel.acted_on("repeat");
    panel.await_decision(false, SessionTime(5s));
    panel.await_key({});
    CHECK_FALSE(panel.poll());
    // What is not asked about leads to no answer: the next command does not wait for it.
    CHECK(press("drift check").key == Key::drift_check);
    CHECK(press("pause").key == Key::pause);
    panel.acted_on("pause");
    panel.await_decision(false, SessionTime(6s));
    CHECK_FALSE(panel.poll());
}

TEST_CASE("gaze that a view's thread has not taken is dropped and counted, and what was taken came",
          "[unit]") {
    const TemporaryFolder folder;
    OperatorServer server(options_at(folder.path() / "view.sock"));
    constexpr std::int64_t pushed = 300'000; // with nobody to wake the thread for
    for (std::int64_t i = 0; i < pushed; ++i)
        server.push_gaze({});
    CHECK(server.dropped() > 0);
    CHECK(server.dropped() < pushed);
}
