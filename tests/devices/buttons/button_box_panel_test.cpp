#include "devices/buttons/button_box_panel.h"

#include <deque>
#include <thread>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "experiment/ports/session_log.h"

using namespace overt;
using namespace std::chrono_literals;
using Key = ResponsePress::Key;

namespace {

/// What a box in memory is told, from the test's thread.
struct Board {
    std::mutex mutex;
    std::deque<ButtonChange> waiting;
    bool is_there = true, is_lost = false, has_clock = true;
    int opened = 0, begun = 0;
};

class BoardBox final : public ButtonBox {
  public:
    explicit BoardBox(Board& board) : board_(board) {
        const std::scoped_lock lock(board_.mutex);
        if (!board_.is_there)
            throw DeviceError("there is no such box");
        ++board_.opened;
        board_.is_lost = false;
    }
    ButtonBoxDescription description() const override { return {"board", "a board", board_.has_clock}; }
    std::string button_name(int button) const override {
        return std::string(1, static_cast<char>('A' + button));
    }
    void begin() override {
        const std::scoped_lock lock(board_.mutex);
        ++board_.begun;
    }
    std::size_t poll(std::span<ButtonChange> into) noexcept override {
        const std::scoped_lock lock(board_.mutex);
        std::size_t taken = 0;
        for (; taken < into.size() && !board_.waiting.empty(); ++taken) {
            into[taken] = board_.waiting.front();
            board_.waiting.pop_front();
        }
        return taken;
    }
    bool lost() const noexcept override {
        const std::scoped_lock lock(board_.mutex);
        return board_.is_lost;
    }

  private:
    Board& board_;
};

class ButtonLog final : public SessionLog {
  public:
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent& event) override {
        events.push_back(std::string(event.kind) + ": " + event.detail);
    }
    void buttons(const std::vector<RecordedButton>& more) override {
        all.insert(all.end(), more.begin(), more.end());
    }
    void key_presses(const std::vector<RecordedKeyPress>& more) override {
        presses.insert(presses.end(), more.begin(), more.end());
    }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
    std::vector<RecordedKeyPress> presses;
    std::vector<RecordedButton> all;
    std::vector<std::string> events;
};

/// A keyboard at which a key was pressed.
class KeyPanel final : public ResponsePanel {
  public:
    void await(Awaited, SessionTime, const Trial*) override {}
    std::optional<ResponsePress> poll() noexcept override { return std::exchange(next, std::nullopt); }
    std::string answer() override { return "typed"; }
    std::optional<ResponsePress> next;
};

struct AnsweringDevices {
    SteadyClock clock;
    Board observers, operators;
    KeyPanel keyboard;
    ButtonLog log;
    std::vector<std::string> told;
    ButtonBoxPanel panel;

    BoxInHand box(Board& board, const char* id, bool is_operators, const std::vector<const char*>& meanings) {
        BoxInHand made{id, is_operators, {}, nullptr};
        for (const char* meaning : meanings)
            made.meanings.push_back(parse_button_meaning(meaning, is_operators));
        made.box = std::make_unique<ThreadedButtonBox>([&board] { return std::make_unique<BoardBox>(board); },
                                                       clock, ThreadedButtonBox::ReadOn::own_thread, 20ms);
        return made;
    }
    std::vector<BoxInHand> boxes(const std::vector<const char*>& observers_buttons) {
        std::vector<BoxInHand> all;
        all.push_back(box(observers, "pad", false, observers_buttons));
        all.push_back(box(operators, "desk", true, {"A pause", "B yes", "C no", "D 2"}));
        return all;
    }
    explicit AnsweringDevices(const std::vector<const char*>& observers_buttons = {"A answer gold",
                                                                                   "B answer silver",
                                                                                   "C back", "D yes", "E no"})
        : panel(boxes(observers_buttons), clock, &keyboard,
                [this](const std::string& sentence) { told.push_back(sentence); }) {}

    void press(Board& board, int button, bool down = true) const {
        const std::scoped_lock lock(board.mutex);
        board.waiting.push_back({button, down, BoxTime(1234us), clock.now(), 700us});
    }
    /// What the panel says of it, within a second.
    std::optional<ResponsePress> said() {
        for (const SessionTime until = clock.now() + 1s; clock.now() < until;) {
            if (const auto press = panel.poll())
                return press;
            std::this_thread::sleep_for(1ms);
        }
        return std::nullopt;
    }
    /// The boxes' threads have taken all that was pressed, and the panel said nothing to it.
    bool says_nothing() {
        for (Board* board : {&observers, &operators})
            for (bool is_empty = false; !is_empty;) {
                std::this_thread::sleep_for(2ms);
                const std::scoped_lock lock(board->mutex);
                is_empty = board->waiting.empty();
            }
        std::this_thread::sleep_for(5ms);
        return !panel.poll();
    }
    template <class Stimulus> void wait_for(Stimulus stimulus) {
        for (int i = 0; i < 2000 && !stimulus(); ++i) {
            panel.write_down(log);
            std::this_thread::sleep_for(1ms);
        }
        CHECK(stimulus());
    }
};

} // namespace

TEST_CASE("a press at a box answers with its own time and words, and is recorded with both edges", "[unit]") {
    AnsweringDevices devices;
    devices.panel.entered(SessionPhase::response_screen, 4);
    devices.panel.await_response({}, devices.clock.now());
    devices.press(devices.observers, 1);
    devices.press(devices.observers, 1, false);
    devices.press(devices.observers, 6); // that means nothing
    const auto press = devices.said();
    REQUIRE(press);
    CHECK(press->key == Key::next);
    CHECK(devices.panel.answer() == "silver");
    CHECK(devices.says_nothing());
    devices.panel.write_down(devices.log);
    REQUIRE(devices.log.all.size() == 3);
    const RecordedButton& down = devices.log.all[0];
    CHECK(down.at == press->pressed_at);
    CHECK(down.uncertainty == 700us);
    CHECK(down.device_time == BoxTime(1234us));
    CHECK(down.trial == 4);
    CHECK(down.box == "pad");
    CHECK(down.name == "B");
    CHECK(down.meaning == "answer silver");
    CHECK(down.is_down);
    CHECK_FALSE(devices.log.all[1].is_down);
    CHECK(devices.log.all[2].meaning.empty());
    // Of presses, not of releases, also what stood on the screen, beside the keys of keyboards.
    REQUIRE(devices.log.presses.size() == 2);
    const RecordedKeyPress& pressed = devices.log.presses[0];
    CHECK(pressed.at == press->pressed_at);
    CHECK(pressed.device == "pad");
    CHECK(pressed.name == "B");
    CHECK(pressed.screen == SessionPhase::response_screen);
    CHECK(pressed.trial == 4);
    CHECK(pressed.meaning == "answer silver");
    CHECK(devices.log.presses[1].name == "G");
    CHECK(devices.log.presses[1].meaning.empty());

    // A key that answers after all is the keyboard's answer.
    devices.panel.await_response({}, devices.clock.now());
    devices.keyboard.next = ResponsePress{Key::next, devices.clock.now(), 0};
    CHECK(devices.said());
    CHECK(devices.panel.answer() == "typed");
}

TEST_CASE("while an answer is awaited, an observer's buttons are told with both edges", "[unit]") {
    AnsweringDevices devices;
    devices.panel.entered(SessionPhase::response_screen, 4);
    devices.press(devices.observers, 1); // too early: it still ends a text
    CHECK(devices.said());
    CHECK_FALSE(devices.panel.next_input());
    devices.panel.await_answer(devices.clock.now(), nullptr);
    devices.press(devices.observers, 1);
    devices.press(devices.observers, 1, false);
    devices.press(devices.operators, 1); // the operator's is not the observer's
    CHECK(devices.says_nothing());
    const auto down = devices.panel.next_input(), up = devices.panel.next_input();
    REQUIRE(down);
    REQUIRE(up);
    CHECK(down->kind == ObserverInput::Kind::key_down);
    CHECK(down->device.view() == "pad");
    CHECK(down->key.view() == "B");
    CHECK(down->uncertainty == 700us);
    CHECK(up->kind == ObserverInput::Kind::key_up);
    CHECK(up->at >= down->at);
    CHECK_FALSE(devices.panel.next_input());
    // They are recorded as ever.
    devices.panel.write_down(devices.log);
    CHECK(devices.log.all.size() == 4);
}

TEST_CASE("neither answers for the other", "[unit]") {
    AnsweringDevices devices;
    // The operator's question: the observer's yes is none, nor is any other of their buttons.
    devices.panel.await_decision(false, devices.clock.now());
    for (int button = 0; button < 5; ++button)
        devices.press(devices.observers, button);
    CHECK(devices.says_nothing());
    devices.press(devices.operators, 1);
    CHECK(devices.said()->key == Key::yes);
    devices.press(devices.operators, 3);
    const auto reason = devices.said();
    REQUIRE(reason);
    CHECK(reason->character == U'2');

    // The observer's consent, a text and a question: the operator's yes is none, and pauses stay pauses.
    devices.panel.await_decision(true, devices.clock.now());
    devices.press(devices.operators, 1);
    devices.press(devices.operators, 2);
    CHECK(devices.says_nothing());
    devices.press(devices.observers, 4);
    CHECK(devices.said()->key == Key::no);
    devices.panel.await_key(devices.clock.now());
    devices.press(devices.operators, 1);
    devices.press(devices.observers, 3); // yes, where nothing is decided
    CHECK(devices.says_nothing());
    devices.press(devices.operators, 0);
    CHECK(devices.said()->key == Key::pause);
    devices.press(devices.observers, 2);
    CHECK(devices.said()->key == Key::back);
    devices.panel.await_response({}, devices.clock.now());
    devices.press(devices.operators, 2);
    CHECK(devices.says_nothing());
    // While a form is filled in, the observer types.
    devices.panel.await_entry(devices.clock.now());
    devices.press(devices.observers, 0);
    CHECK(devices.says_nothing());
}

TEST_CASE("what was pressed before a question stood there does not answer it; the operator's stays",
          "[unit]") {
    AnsweringDevices devices(std::vector<const char*>{});
    devices.panel.await_key(devices.clock.now());
    devices.press(devices.observers, 0);
    devices.press(devices.operators, 0);
    std::this_thread::sleep_for(20ms); // the threads have them
    devices.panel.await_response({}, devices.clock.now());
    const auto press = devices.said();
    REQUIRE(press);
    CHECK(press->key == Key::pause);
    CHECK(devices.says_nothing());
    // A change that arrives late was before it, too.
    devices.panel.await_response({}, devices.clock.now() + 10s);
    devices.press(devices.observers, 0);
    CHECK(devices.says_nothing());
    // Without a mapping any button goes on, and answers nothing.
    devices.panel.await_response({}, devices.clock.now());
    devices.press(devices.observers, 3);
    CHECK(devices.said()->key == Key::next);
    CHECK(devices.panel.answer().empty());
    devices.panel.write_down(devices.log);
    CHECK(devices.log.all.size() == 4);
}

TEST_CASE("what is recorded before anybody asks is told afterwards, and recorded once", "[unit]") {
    AnsweringDevices devices;
    devices.panel.await_response({}, devices.clock.now());
    devices.press(devices.observers, 0);
    devices.wait_for([&] { return devices.log.all.size() == 1; });
    const auto press = devices.said();
    REQUIRE(press);
    CHECK(press->pressed_at == devices.log.all[0].at);
    CHECK(devices.panel.answer() == "gold");
    CHECK(devices.says_nothing());
    devices.press(devices.observers, 0, false);
    devices.wait_for([&] { return devices.log.all.size() == 2; });
    CHECK(devices.says_nothing());
}

TEST_CASE("a box that is gone is data, is said, and is found again; the keyboard goes on", "[unit]") {
    AnsweringDevices devices;
    {
        const std::scoped_lock lock(devices.observers.mutex);
        devices.observers.is_there = false;
        devices.observers.is_lost = true;
    }
    devices.wait_for([&] { return devices.told.size() == 1; });
    CHECK_THAT(devices.told[0], Catch::Contains("\"pad\" does not answer any more"));
    devices.panel.await_response({}, devices.clock.now());
    devices.keyboard.next = ResponsePress{Key::next, devices.clock.now(), 0};
    CHECK(devices.said());
    {
        const std::scoped_lock lock(devices.observers.mutex);
        devices.observers.is_there = true;
    }
    devices.wait_for([&] { return devices.told.size() == 2; });
    CHECK_THAT(devices.told[1], Catch::Contains("\"pad\" is there again"));
    CHECK(std::ranges::count(devices.log.events, "response box lost: pad: a board") == 1);
    CHECK(std::ranges::count(devices.log.events, "response box regained: pad: a board") == 1);
    CHECK(std::ranges::count(devices.log.events,
                             "response box: pad: a board, of the observer, with a clock of its own") == 1);
    devices.panel.await_response({}, devices.clock.now());
    devices.press(devices.observers, 0);
    CHECK(devices.said());
    CHECK(devices.panel.answer() == "gold");
    REQUIRE(devices.panel.closing_warnings().size() == 1);
    CHECK_THAT(devices.panel.closing_warnings()[0], Catch::Contains("it was gone 1 time"));
}

TEST_CASE("a box reads its clock before each trial, and a button that it lacks is refused", "[unit]") {
    AnsweringDevices devices;
    devices.panel.entered(SessionPhase::trial, 0);
    devices.wait_for([&] {
        const std::scoped_lock lock(devices.observers.mutex);
        return devices.observers.begun == 1;
    });
    std::vector<BoxInHand> boxes;
    boxes.push_back(devices.box(devices.operators, "desk", false, {"seventh next"}));
    CHECK_THROWS_WITH(ButtonBoxPanel(std::move(boxes), devices.clock, nullptr, [](const std::string&) {}),
                      Catch::Contains("board boxes have no button \"seventh\""));
    devices.observers.is_there = false;
    CHECK_THROWS_AS(devices.box(devices.observers, "pad", false, {}), DeviceError);
}

TEST_CASE(
    "what a knob of the observer does is told axis by axis while an answer is awaited, and is no button's",
    "[unit]") {
    AnsweringDevices devices;
    const auto turn = [&](Board& board, int turns, int tilts) {
        const std::scoped_lock lock(board.mutex);
        ButtonChange change{-1, false, {}, devices.clock.now(), 700us};
        change.turn_steps = turns;
        change.tilt_steps = tilts;
        board.waiting.push_back(change);
    };
    devices.panel.entered(SessionPhase::stimulus, 4);
    turn(devices.observers, 5, 0); // too early
    CHECK(devices.says_nothing());
    devices.panel.await_answer(devices.clock.now(), nullptr);
    turn(devices.observers, -2, 3);
    turn(devices.operators, 1, 1);
    CHECK(devices.says_nothing());
    const auto dial = devices.panel.next_input(), tilt = devices.panel.next_input();
    REQUIRE(dial);
    REQUIRE(tilt);
    CHECK(dial->kind == ObserverInput::Kind::dial);
    CHECK(dial->steps == -2.0);
    CHECK(dial->device.view() == "pad");
    CHECK(dial->uncertainty == 700us);
    CHECK(tilt->kind == ObserverInput::Kind::tilt);
    CHECK(tilt->steps == 3.0);
    CHECK_FALSE(devices.panel.next_input());
    turn(devices.observers, 1, 0);
    CHECK(devices.says_nothing());
    devices.panel.write_down(devices.log);
    CHECK(devices.log.all.empty()); // of what it moved the record tells
}

TEST_CASE("changes that a box had no room for are told of, with their number and the box's name", "[unit]") {
    AnsweringDevices devices(std::vector<const char*>{});
    constexpr int many = 20'000;
    {
        const std::scoped_lock lock(devices.observers.mutex);
        for (int i = 0; i < many; ++i)
            devices.observers.waiting.push_back(
                {.button = 1, .is_down = i % 2 == 0, .device_time = {}, .at = devices.clock.now()});
    }
    for (int tries = 0; tries < 5000; ++tries) {
        std::this_thread::sleep_for(1ms);
        const std::scoped_lock lock(devices.observers.mutex);
        if (devices.observers.waiting.empty())
            break;
    }
    std::this_thread::sleep_for(5ms);
    devices.panel.write_down(devices.log);
    const auto said = devices.panel.closing_warnings();
    REQUIRE_FALSE(said.empty());
    CHECK_THAT(said.front(), Catch::StartsWith("response box \"pad\": ") &&
                                 Catch::EndsWith(" changes went lost: too many at once"));
}
