/// What of a box is taken for what, read on the session's own thread: each key at each question, to the
/// bounds of time and of room.
#include <deque>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "devices/buttons/button_box_panel.h"
#include "experiment/base/error.h"
#include "experiment/ports/session_log.h"
#include "tests/support/counted_clock.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// What happens to a box that is polled where it is asked.
struct HeldBoard {
    std::deque<ButtonChange> waiting;
    bool is_lost = false;
    int begun = 0;
};

class HeldBox final : public ButtonBox {
  public:
    explicit HeldBox(HeldBoard& board) : board_(board) {}
    ButtonBoxDescription description() const override { return {"held", "a held box", false}; }
    void begin() override { ++board_.begun; }
    std::size_t poll(std::span<ButtonChange> into) noexcept override {
        std::size_t taken = 0;
        for (; taken < into.size() && !board_.waiting.empty(); ++taken) {
            into[taken] = board_.waiting.front();
            board_.waiting.pop_front();
        }
        return taken;
    }
    bool lost() const noexcept override { return board_.is_lost; }

  private:
    HeldBoard& board_;
};

class HeldLog final : public SessionLog {
  public:
    std::vector<RecordedButton> all;
    std::vector<RecordedKeyPress> presses;
    std::vector<std::string> events;
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent& event) override {
        events.push_back(fmt::format("{} {}: {}", event.trial, event.kind, event.detail));
    }
    void buttons(const std::vector<RecordedButton>& more) override {
        all.insert(all.end(), more.begin(), more.end());
    }
    void key_presses(const std::vector<RecordedKeyPress>& more) override {
        presses.insert(presses.end(), more.begin(), more.end());
    }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
};

struct HeldBoxes {
    CountedClock clock;
    HeldBoard pad, desk;
    HeldLog log;
    std::vector<std::string> told;
    ButtonBoxPanel panel{boxes(), clock, nullptr,
                         [this](const std::string& words) { told.push_back(words); }};

    BoxInHand box(HeldBoard& board, const char* id, bool is_operators,
                  const std::vector<const char*>& meanings) {
        BoxInHand made{id, is_operators, {}, nullptr};
        for (const char* meaning : meanings)
            made.meanings.push_back(parse_button_meaning(meaning, is_operators));
        made.box = std::make_unique<ThreadedButtonBox>([&board] { return std::make_unique<HeldBox>(board); },
                                                       clock, ThreadedButtonBox::ReadOn::sessions_thread);
        return made;
    }
    std::vector<BoxInHand> boxes() {
        std::vector<BoxInHand> all;
        all.push_back(box(pad, "pad", false, {"1 answer gold", "2 next", "3 back", "4 yes", "5 no"}));
        all.push_back(box(desk, "desk", true, {"1 pause", "2 yes", "3 no", "4 skip", "5 7"}));
        return all;
    }
    static ButtonChange change_of(int button, SessionTime at, bool is_down = true) {
        ButtonChange change;
        change.button = button;
        change.is_down = is_down;
        change.at = at;
        change.uncertainty = 300us;
        return change;
    }
    /// By which keys a button of a box is taken at a question; "" if for nothing.
    std::string taken(HeldBoard& board, int button, SessionDuration since_asked = {}, bool is_down = true) {
        board.waiting.push_back(change_of(button, clock.time + since_asked, is_down));
        const auto press = panel.poll();
        if (!press)
            return "";
        CHECK(press->pressed_at == clock.time + since_asked);
        using Key = ResponsePress::Key;
        if (press->key == Key::character)
            return std::string(1, static_cast<char>(press->character));
        for (const auto& [key, word] :
             {std::pair{Key::next, "next"}, {Key::back, "back"}, {Key::yes, "yes"}, {Key::no, "no"}})
            if (press->key == key)
                return word;
        return std::string(name_of(press->key));
    }
};

} // namespace

TEST_CASE("each button of a box is taken at the questions that it answers, and at no others", "[unit]") {
    HeldBoxes held;
    const auto all_taken = [&](HeldBoard& board, Awaited what) {
        std::string all;
        for (int button = 0; button <= 6; ++button) {
            held.panel.await(what, held.clock.time, nullptr);
            all += (button == 0 ? "" : ",") + held.taken(board, button);
            CHECK(held.taken(board, button, {}, false).empty()); // letting go is nothing
        }
        return all;
    };
    using enum Awaited;
    CHECK(all_taken(held.pad, key) == ",next,next,back,,,");
    CHECK(all_taken(held.pad, response) == ",next,next,,,,");
    CHECK(all_taken(held.pad, consent) == ",,,,yes,no,");
    for (const Awaited what : {decision, entry, setup, answer})
        CHECK(all_taken(held.pad, what) == ",,,,,,");
    for (const Awaited what : {key, response, consent, entry, setup, answer})
        CHECK(all_taken(held.desk, what) == ",pause,,,skip,,");
    CHECK(all_taken(held.desk, decision) == ",pause,yes,no,skip,7,");
}

TEST_CASE("an observer's press counts from the instant of the question on, an operator's at any time",
          "[unit]") {
    HeldBoxes held;
    held.panel.await(Awaited::response, held.clock.time, nullptr);
    CHECK(held.taken(held.pad, 1, -1ns).empty());
    CHECK(held.panel.answer().empty());
    CHECK(held.taken(held.desk, 1, -1s) == "pause");
    CHECK(held.taken(held.pad, 1, 0ns) == "next");
    CHECK(held.panel.answer() == "gold");
    held.panel.await(Awaited::response, held.clock.time, nullptr);
    CHECK(held.panel.answer().empty());
    CHECK(held.taken(held.pad, 2) == "next");
    CHECK(held.panel.answer().empty());
}

TEST_CASE("an operator's presses while something is prepared stay in their order, sixteen of them",
          "[unit]") {
    HeldBoxes held;
    held.panel.await(Awaited::key, held.clock.time, nullptr);
    for (int i = 0; i < 18; ++i)
        held.desk.waiting.push_back(HeldBoxes::change_of(i % 2 == 0 ? 1 : 4, held.clock.time + i * 1ms));
    held.pad.waiting.push_back(HeldBoxes::change_of(2, held.clock.time));
    held.panel.await(Awaited::response, held.clock.time, nullptr);
    for (int i = 0; i < 16; ++i) {
        const auto press = held.panel.poll();
        REQUIRE(press);
        CHECK(press->key == (i % 2 == 0 ? ResponsePress::Key::pause : ResponsePress::Key::skip));
        CHECK(press->pressed_at == held.clock.time + i * 1ms);
    }
    CHECK_FALSE(held.panel.poll());
}

TEST_CASE(
    "of an observer's inputs 128 wait, each with its name, time and edge, and a knob's axes by themselves",
    "[unit]") {
    HeldBoxes held;
    held.panel.await(Awaited::answer, held.clock.time, nullptr);
    held.pad.waiting.push_back(HeldBoxes::change_of(511, held.clock.time, true));
    held.pad.waiting.push_back(HeldBoxes::change_of(0, held.clock.time, false));
    for (const int button : {-1, 512}) // no button's number
        held.pad.waiting.push_back(HeldBoxes::change_of(button, held.clock.time));
    held.pad.waiting.push_back(HeldBoxes::change_of(3, held.clock.time - 1ns));
    held.desk.waiting.push_back(HeldBoxes::change_of(3, held.clock.time));
    ButtonChange turn = HeldBoxes::change_of(-1, held.clock.time);
    turn.turn_steps = 2;
    held.pad.waiting.push_back(turn);
    turn.turn_steps = 0;
    turn.tilt_steps = -1;
    held.pad.waiting.push_back(turn);
    CHECK_FALSE(held.panel.poll());
    std::vector<ObserverInput> inputs;
    while (const auto input = held.panel.next_input())
        inputs.push_back(*input);
    REQUIRE(inputs.size() == 4);
    using Kind = ObserverInput::Kind;
    CHECK((inputs[0].kind == Kind::key_down && inputs[0].key.view() == "511" &&
           inputs[0].device.view() == "pad"));
    CHECK((inputs[0].at == held.clock.time && inputs[0].uncertainty == 300us));
    CHECK((inputs[1].kind == Kind::key_up && inputs[1].key.view() == "0"));
    CHECK((inputs[2].kind == Kind::dial && inputs[2].steps == 2));
    CHECK((inputs[3].kind == Kind::tilt && inputs[3].steps == -1));
    for (int i = 0; i < 130; ++i)
        held.pad.waiting.push_back(HeldBoxes::change_of(i, held.clock.time));
    CHECK_FALSE(held.panel.poll());
    int count = 0;
    for (std::string last; const auto input = held.panel.next_input(); ++count)
        CHECK(input->key.view() == std::to_string(count));
    CHECK(count == 128);
}

TEST_CASE("what a box did is recorded once, with its meaning, and as a key only where keys are recorded",
          "[unit]") {
    HeldBoxes held;
    held.panel.entered(SessionPhase::trial, 4);
    CHECK(held.pad.begun == 1);
    held.panel.entered(SessionPhase::stimulus, 4);
    CHECK(held.pad.begun == 1); // in a trial there is no time to read its clock
    held.pad.waiting.push_back(HeldBoxes::change_of(1, held.clock.time));
    held.pad.waiting.push_back(HeldBoxes::change_of(1, held.clock.time + 70ms, false));
    held.pad.waiting.push_back(HeldBoxes::change_of(6, held.clock.time));
    held.desk.waiting.push_back(HeldBoxes::change_of(1, held.clock.time));
    held.panel.write_down(held.log);
    held.panel.write_down(held.log);
    REQUIRE(held.log.events.size() == 2);
    CHECK(held.log.events[0] ==
          "-1 response box: pad: a held box, of the observer, without a clock: times are those of "
          "arrival");
    CHECK(held.log.events[1] ==
          "-1 response box: desk: a held box, of the operator, without a clock: times are those "
          "of arrival");
    REQUIRE(held.log.all.size() == 4);
    const RecordedButton& first = held.log.all[0];
    CHECK(
        (first.button == 1 && first.name == "1" && first.is_down && first.box == "pad" && first.trial == 4));
    CHECK((first.at == held.clock.time && first.uncertainty == 300us && !first.is_operators));
    CHECK(first.meaning == parse_button_meaning("1 answer gold", false).words);
    CHECK_FALSE(held.log.all[1].is_down);
    CHECK(held.log.all[2].meaning.empty());
    CHECK(held.log.all[3].is_operators);
    for (const RecordedKeyPress& press : held.log.presses)
        CHECK((press.screen == SessionPhase::stimulus && press.trial == 4 && press.at == held.clock.time));
    CHECK(held.log.presses.size() == 3); // those that went down
    CHECK(held.log.presses[0].code == 1);
    // It is still told, whoever asks next.
    const auto press = held.panel.poll();
    REQUIRE(press);
    CHECK(press->key == ResponsePress::Key::next);
    held.panel.entered(SessionPhase::rest, -1);
    CHECK(held.pad.begun == 2);
}

TEST_CASE("a box that is gone, and changes that found no room, are said in the end with their numbers",
          "[unit]") {
    HeldBoxes held;
    held.panel.entered(SessionPhase::stimulus, 2);
    CHECK(held.panel.closing_warnings().empty());
    held.pad.is_lost = true;
    held.clock.time += 5s;
    CHECK_FALSE(held.panel.poll());
    CHECK_FALSE(held.panel.poll());
    held.clock.time += 5s;
    held.panel.write_down(held.log);
    REQUIRE(held.log.events.size() == 3);
    CHECK(held.log.events[1] == "2 response box lost: pad: a held box");
    REQUIRE(held.told.size() == 1);
    CHECK_THAT(held.told[0], Catch::StartsWith("the response box \"pad\" does not answer any more"));
    CHECK(held.panel.closing_warnings() ==
          std::vector<std::string>{
              "response box \"pad\": it was gone 1 time: what was pressed then is not known"});
    for (int i = 0; i < 4099; ++i)
        held.desk.waiting.push_back(HeldBoxes::change_of(6, held.clock.time));
    CHECK_FALSE(held.panel.poll());
    held.panel.write_down(held.log);
    CHECK(held.log.all.size() == 4096);
    CHECK(held.panel.closing_warnings().at(1) ==
          "response boxes: 3 changes could not be recorded: too many in one presentation");
}

TEST_CASE("of a knob's turns both axes wait as long as there is room, and nothing is written beyond it",
          "[unit]") {
    HeldBoxes held;
    for (const int before : {0, 1}) {
        held.panel.await(Awaited::answer, held.clock.time, nullptr);
        for (int i = 0; i < before; ++i)
            held.pad.waiting.push_back(HeldBoxes::change_of(2, held.clock.time));
        for (int i = 1; i <= 70; ++i) {
            ButtonChange turn = HeldBoxes::change_of(-1, held.clock.time);
            turn.turn_steps = i;
            turn.tilt_steps = -i;
            held.pad.waiting.push_back(turn);
        }
        CHECK_FALSE(held.panel.poll());
        int count = 0;
        while (const auto input = held.panel.next_input()) {
            if (count >= before)
                CHECK(input->steps == ((count - before) % 2 == 0 ? 1 : -1) * ((count - before) / 2 + 1));
            ++count;
        }
        CHECK(count == 128);
    }
    // Before the question, of an operator's knob and without a step it is nothing.
    held.panel.await(Awaited::answer, held.clock.time, nullptr);
    ButtonChange turn = HeldBoxes::change_of(-1, held.clock.time - 1ns);
    turn.turn_steps = 1;
    held.pad.waiting.push_back(turn);
    turn.at = held.clock.time;
    held.desk.waiting.push_back(turn);
    CHECK_FALSE(held.panel.poll());
    CHECK_FALSE(held.panel.next_input());
    held.panel.await(Awaited::key, held.clock.time, nullptr);
    held.pad.waiting.push_back(turn);
    CHECK_FALSE(held.panel.poll());
    CHECK_FALSE(held.panel.next_input());
}
