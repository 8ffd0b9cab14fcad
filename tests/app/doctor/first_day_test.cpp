/// A lab's first day with its hardware, rehearsed: what is simulated proves nothing, nothing is lost, and
/// sessions name the page.
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "app/doctor/box_light.h"
#include "app/doctor/first_day.h"
#include "app/doctor/first_day_steps.h"
#include "app/doctor/rig_page_html.h"
#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "tests/app/small_experiment.h"
#include "tests/devices/link/terminal_device.h"
#include "tests/support/hurried_observer.h"
#include "tests/support/running_program.h"
#include "tests/support/seen_screen.h"
#include "tests/support/skip.h"
#include "tests/support/two_monitors.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

RigStep step_of(const char* name, StepVerdict verdict, RigFacts facts) {
    RigStep step;
    step.name = name;
    step.verdict = verdict;
    step.finding = "5 ms <late> & \"well\"";
    step.measured_utc = "2026-11-27T09:00:00Z";
    step.figures = {at_most("latency", 5.0, "ms", 6.0), {"changes", 12.0, ""}};
    step.facts = std::move(facts);
    return step;
}

RigPage small_page() {
    return {"2026-11-27T09:00:00Z",
            "small",
            "overt 0",
            {step_of("light", StepVerdict::proved, {{screen_fact, "a"}}),
             step_of("stream", StepVerdict::proved, {{tracker_fact, "eyelink at 1000 Hz"}}),
             step_of("markers", StepVerdict::failed, {}), step_of("bytes", StepVerdict::not_proved, {})}};
}

/// Tells what it is given.
class ToldBox final : public ButtonBox {
  public:
    explicit ToldBox(std::deque<ButtonChange> changes) : changes_(std::move(changes)) {}
    ButtonBoxDescription description() const override { return {"told", "a box", true}; }
    void begin() override {}
    std::size_t poll(std::span<ButtonChange> into) noexcept override {
        std::size_t taken = 0;
        for (; taken < into.size() && !changes_.empty(); ++taken, changes_.pop_front())
            into[taken] = changes_.front();
        return taken;
    }
    bool lost() const noexcept override { return false; }

  private:
    std::deque<ButtonChange> changes_;
};

/// A small experiment's protocol for screens of X that prove no times.
std::string unproven_protocol() {
    return with(with(small_protocol, "refresh_hz = 120", "refresh_hz = 60"), "output = \"color++\"",
                "output = \"native-8bit\"\ngamma = 2.2\nlinearised_by = \"none\"\ntiming = \"unproven\"");
}

/// A light sensor at one port, and an RB-730 of Cedrus with one across its third button at another: both look
/// at a virtual screen.
class LightAtPorts {
  public:
    explicit LightAtPorts(const std::filesystem::path& framebuffer) : seen_(framebuffer) {
        sensor_ = std::make_unique<TerminalDevice>(
            sensor_line_.master(), [](std::string_view, double) { return std::string(); },
            [this](double) {
                const bool is_light = sees_light();
                const bool is_edge = std::exchange(sensor_sees_, is_light) != is_light;
                return std::string(is_edge ? (is_light ? "1" : "0") : "");
            });
        box_ = std::make_unique<TerminalDevice>(
            box_line_.master(), [this](std::string_view bytes, double now_s) { return answer(bytes, now_s); },
            [this](double now_s) { return key(now_s); });
    }

    const std::string& sensor_port() const { return sensor_line_.path(); }
    const std::string& box_port() const { return box_line_.path(); }

    std::atomic<int> late_ms{0};      ///< what the box's times are too late by
    std::atomic<bool> is_dark{false}; ///< the box's sensor sees nothing

  private:
    bool sees_light() const {
        constexpr int between_px = 8, light = 128;
        for (int y = between_px / 2; y < seen_.height(); y += between_px)
            for (int x = between_px / 2; x < seen_.width(); x += between_px)
                if (seen_.at(x, y)[1] >= light)
                    return true;
        return false;
    }
    std::string number(std::uint32_t ms) const {
        std::string bytes;
        for (int i = 0; i < 4; ++i)
            bytes += static_cast<char>(ms >> (8 * i) & 0xFF);
        return bytes;
    }
    std::uint32_t ms(double now_s) const { return static_cast<std::uint32_t>((now_s - zero_s_) * 1e3); }
    std::string answer(std::string_view bytes, double now_s) {
        heard_ += bytes;
        if (heard_.ends_with("_c1"))
            return "_xid0";
        if (heard_.ends_with("_d2") || heard_.ends_with("_d3") || heard_.ends_with("_d4"))
            return "2";
        if (heard_.ends_with("_e5"))
            return "_e5" + number(ms(now_s));
        if (heard_.ends_with("e5"))
            zero_s_ = now_s;
        return {};
    }
    std::string key(double now_s) {
        const bool is_light = !is_dark && sees_light();
        if (std::exchange(box_sees_, is_light) == is_light)
            return {};
        return std::string("k") + static_cast<char>(3 << 5 | (is_light ? 0x10 : 0)) +
               number(ms(now_s) + static_cast<std::uint32_t>(late_ms.load()));
    }

    SeenScreen seen_;
    Terminal sensor_line_, box_line_;
    bool sensor_sees_ = false, box_sees_ = false;
    std::string heard_;
    double zero_s_ = 0.0;
    std::unique_ptr<TerminalDevice> sensor_, box_; ///< last: their threads use all of the above
};

} // namespace

TEST_CASE("a rig's page comes back from its text, and other texts are refused by name", "[unit]") {
    const RigPage page = small_page();
    const std::string text = to_json_text(page);
    const RigPage again = rig_page_from(text, "rig.json");
    CHECK(to_json_text(again) == text);
    CHECK(again.steps[0].figures[0].holds == true);
    CHECK(again.steps[1].facts == page.steps[1].facts);
    for (const std::string& other :
         {std::string("{}"), std::string("[1]"), std::string("no JSON"), text.substr(0, text.size() / 2)})
        CHECK_THROWS_WITH(rig_page_from(other, "rig.json"), Contains("rig.json"));
}

TEST_CASE("a record says what a rig's page proves, and of which rig it is", "[unit]") {
    const KeptRigPage kept{small_page(), "/home/lab/rig.json", "abc"};
    const std::string same = sentence_of(kept, {{screen_fact, "a"}, {tracker_fact, "eyelink at 1000 Hz"}});
    CHECK_THAT(same, Contains("proved: light, stream") && Contains("failed: markers") &&
                         Contains("not proved: bytes") && Contains("SHA-256 abc"));
    CHECK_THAT(same, !Contains("ANOTHER RIG") && !Contains("/home"));
    const std::string other = sentence_of(kept, {{screen_fact, "a"}, {tracker_fact, "tobii at 60 Hz"}});
    CHECK_THAT(other, Contains("THE PAGE IS OF ANOTHER RIG: the eye tracker was eyelink at 1000 Hz, is tobii "
                               "at 60 Hz; measured there and not here: stream"));
    CHECK_THAT(other, Contains("proved: light;"));
    CHECK_THAT(sentence_of(std::nullopt, {}), Contains("none") && Contains("--first-day"));
}

TEST_CASE("what is simulated is never proved, and what misses a bound failed", "[unit]") {
    const RigStep good = judged({at_most("a", 1.0, "", 2.0)}, "well", "mend it");
    CHECK(good.verdict == StepVerdict::proved);
    CHECK(good.remedy.empty());
    CHECK(as_simulated(good, "a tracker").verdict == StepVerdict::not_proved);
    CHECK_THAT(as_simulated(good, "a tracker").finding, Contains("SIMULATED: a tracker"));
    const RigStep bad = judged({at_most("a", 3.0, "", 2.0)}, "ill", "mend it");
    CHECK(bad.verdict == StepVerdict::failed);
    CHECK(as_simulated(bad, "a tracker").verdict == StepVerdict::failed);
    CHECK(bad.remedy == "mend it");
    CHECK(first_day_steps().size() == names_of_steps().size());
}

TEST_CASE("the page that is read names each verdict and hides no character", "[unit]") {
    const std::string html = rig_page_html(small_page());
    CHECK_THAT(html, Contains("What is proved on this rig, 2026-11-27, 09:00 UTC") && Contains("at most 6"));
    // Each step is found from the top.
    for (const RigStep& step : small_page().steps)
        CHECK_THAT(html, Contains("<a href=\"#" + step.name + "\">"));
    CHECK_THAT(html, Contains("5 ms &lt;late> &amp; &quot;well&quot;"));
    const auto place = [&](const char* text) { return html.find(text); };
    CHECK(place("id=\"markers\"") > place("<section id=\"failed\""));
    CHECK(place("id=\"markers\"") < place("<section id=\"not_proved\""));
    CHECK(place("id=\"light\"") > place("<section id=\"proved\""));
}

TEST_CASE("a response box tells light as a sensor does", "[unit]") {
    SteadyClock clock;
    using namespace std::chrono_literals;
    std::deque<ButtonChange> changes;
    for (int i = 0; i < 4; ++i)
        changes.push_back({3, i % 2 == 0, std::nullopt, SessionTime(i * 50ms), 1ms});
    changes[2].uncertainty = 3ms;
    changes.push_back({0, false, std::nullopt, SessionTime(1s), 0ms, 2}); // a knob is no light
    BoxWords words;
    const auto box = [&] {
        return std::make_unique<ThreadedButtonBox>([&] { return std::make_unique<ToldBox>(changes); }, clock,
                                                   ThreadedButtonBox::ReadOn::sessions_thread);
    };
    BoxLightSensor sensor(box(), words);
    const std::vector<LightEdge> edges = sensor.edges();
    REQUIRE(edges.size() == 4);
    CHECK(edges[0].is_light);
    CHECK_FALSE(edges[1].is_light);
    CHECK(edges[3].at == SessionTime(150ms));
    CHECK(words.worst_uncertainty == 3ms);
    CHECK(words.description.model == "a box");
}

TEST_CASE("a first day is rehearsed, broken off, gone on with, and named in sessions", "[session][waits]") {
    const SmallExperiment experiment;
    const std::filesystem::path state = experiment.folder().path() / "state";
    const std::vector<std::string> environment{"OVERT_STATE=" + state.string()};
    const auto first_day = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"doctor",
                                     experiment.protocol().string(),
                                     "--first-day",
                                     "--context",
                                     "osmesa",
                                     "--simulate-observer",
                                     "5",
                                     "--sensor",
                                     "simulated",
                                     "--seconds",
                                     "1",
                                     "--clock-minutes",
                                     "0.02",
                                     "--trials",
                                     "2"};
        all.insert(all.end(), more.begin(), more.end());
        return experiment.overt(all, environment);
    };
    const auto page = [&] {
        const std::filesystem::path file = rig_page_file(state / "rig");
        return rig_page_from(text_of(file), file);
    };
    const auto verdict_of = [&](const RigPage& of, std::string_view name) {
        return std::ranges::find(of.steps, name, &RigStep::name)->verdict;
    };

    // Broken off: steps that were left out stay open.
    const ProgramRun begun = first_day({"--skip", "accuracy", "--skip", "trials"});
    INFO(begun.out << begun.err);
    REQUIRE(begun.exit_code == 0);
    const RigPage half = page();
    CHECK_FALSE(half.is_finished());
    CHECK(verdict_of(half, "accuracy") == StepVerdict::open);
    CHECK_THAT(begun.out, Contains("the same command goes on"));

    // Gone on with: what was measured is not measured again.
    const ProgramRun rest = first_day({});
    INFO(rest.out << rest.err);
    REQUIRE(rest.exit_code == 0);
    const RigPage whole = page();
    CHECK(whole.is_finished());
    CHECK(whole.begun_utc == half.begun_utc);
    CHECK_THAT(rest.out, !Contains("== light") && Contains("== accuracy") && Contains("== trials"));
    for (const RigStep& step : whole.steps) {
        CAPTURE(step.name, step.finding);
        CHECK(step.verdict == StepVerdict::not_proved);
        CHECK_FALSE(step.remedy.empty());
    }
    for (const char* const name : {"light", "stream", "accuracy", "clock", "trials"})
        CHECK(std::ranges::find(whole.steps, name, &RigStep::name)->is_simulated);
    CHECK(std::filesystem::exists(state / "rig/rig.html"));

    const ProgramRun finished = first_day({});
    CHECK_THAT(finished.out, Contains("is finished"));

    // A session on this rig names the page; with another tracker it says that the page is of another rig.
    const auto run = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"run",
                                     experiment.protocol().string(),
                                     "--observer",
                                     "P01",
                                     "--sessions",
                                     experiment.sessions().string(),
                                     "--context",
                                     "osmesa",
                                     "--trials",
                                     "1",
                                     "--simulate-observer",
                                     "5"};
        all.insert(all.end(), more.begin(), more.end());
        for (std::string& option : hurried(1))
            all.push_back(std::move(option));
        const ProgramRun done = experiment.overt(all, environment);
        INFO(done.err);
        REQUIRE(done.exit_code == 0);
    };
    run({});
    run({"--tracker", "none"});
    const auto shown = [&](int number) {
        return experiment.overt({"show", experiment.session(number).string()}).out;
    };
    CHECK_THAT(shown(1), Contains("page of the rig in sitting 1: begun " + whole.begun_utc) &&
                             Contains("not proved: bytes") && !Contains("ANOTHER RIG"));
    CHECK_THAT(shown(2),
               Contains("THE PAGE IS OF ANOTHER RIG: the eye tracker was simulated at 1000 Hz, is none"));
    const ProgramRun verified = experiment.overt({"verify", experiment.session(2).string()});
    CHECK(verified.exit_code == 0);
    CHECK_THAT(verified.out, Contains("page of the rig in sitting 1: begun " + whole.begun_utc));

    // Another rig: what depends on what changed is open again, and another day keeps the earlier page.
    const std::string text = text_of(experiment.protocol());
    std::ofstream(experiment.protocol()) << with(text, "rate_hz = 1000", "rate_hz = 500");
    const ProgramRun other = first_day({"--skip", "trials", "--skip", "accuracy"});
    CHECK_THAT(other.out, Contains("== stream") && Contains("== clock") && !Contains("== light"));
    CHECK(first_day({"--anew", "--step", "screen"}).exit_code == 0);
    CHECK(std::ranges::count_if(page().steps,
                                [](const RigStep& step) { return step.verdict == StepVerdict::open; }) == 8);
    int kept = 0;
    for (const auto& entry : std::filesystem::directory_iterator(state / "rig"))
        kept += entry.path().filename().string().starts_with("rig_") ? 1 : 0;
    CHECK(kept == 2);
}

TEST_CASE("what changes the signal on its way to the screen stands on the first day's page", "[session]") {
    const auto desk = TwoMonitors::start();
    if (!desk || std::system("xgamma -rgamma 1.5 >/dev/null 2>&1") != 0)
        OVERT_SKIP("there is no Xorg with a dummy card here");
    const SmallExperiment experiment;
    const std::filesystem::path state = experiment.folder().path() / "state";
    const ProgramRun day = experiment.overt({"doctor", experiment.protocol().string(), "--first-day",
                                             "--step", "screen", "--monitor", "1", "--seconds", "0.5"},
                                            {"OVERT_STATE=" + state.string()});
    INFO(day.out << day.err);
    CHECK(day.exit_code == 1);
    const RigPage page = rig_page_from(text_of(rig_page_file(state / "rig")), "rig.json");
    const RigStep& step = *std::ranges::find(page.steps, "screen", &RigStep::name);
    CHECK(step.verdict == StepVerdict::failed);
    CHECK_THAT(step.finding, Contains("gamma table: not the identity") && Contains("1.5 (red)"));
}

TEST_CASE("a step that is broken off stays open, and ends the day", "[session][waits]") {
    const SmallExperiment experiment;
    const std::filesystem::path state = experiment.folder().path() / "state",
                                said = experiment.folder().path() / "said";
    RunningProgram day({"doctor", experiment.protocol().string(), "--first-day", "--context", "osmesa",
                        "--simulate-observer", "5", "--clock-minutes", "5", "--step", "clock", "--step",
                        "boxes"},
                       {"OVERT_STATE=" + state.string(), "OVERT_CACHE=" + experiment.cache().string()}, said);
    // The clock's step has three readings after 3 s, by which it could be judged.
    for (int i = 0; i < 600 && text_of(said).find("== clock") == std::string::npos; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::this_thread::sleep_for(std::chrono::seconds(4));
    day.signal(SIGINT);
    CHECK(day.wait() != 0);
    const std::string words = text_of(said);
    INFO(words);
    CHECK_THAT(words, !Contains("== boxes"));
    for (const RigStep& step : rig_page_from(text_of(rig_page_file(state / "rig")), "rig.json").steps)
        CHECK(step.verdict == StepVerdict::open);
}

TEST_CASE("at a terminal each step waits until it is begun, left open, or the day ended", "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path state = experiment.folder().path() / "state",
                                said = experiment.folder().path() / "said";
    // Another word is none of these, and asked about again.
    const std::string command =
        fmt::format("printf 'what\\ns\\ns\\n\\nq\\n' | OVERT_STATE={} OVERT_CACHE={} script -qec '{} doctor "
                    "{} --first-day "
                    "--context osmesa --sensor simulated --seconds 0.2' /dev/null > {}",
                    state.string(), experiment.cache().string(), OVERT_PROGRAM,
                    experiment.protocol().string(), said.string());
    REQUIRE(std::system(command.c_str()) == 0);
    const std::string words = text_of(said);
    INFO(words);
    const std::string prompt = "q: go on another day >";
    int asked = 0;
    for (std::size_t at = words.find(prompt); at != std::string::npos; at = words.find(prompt, at + 1))
        ++asked;
    CHECK(asked == 5);
    CHECK_THAT(words, Contains("bytes stays open") && Contains("screen stays open"));
    const RigPage page = rig_page_from(text_of(rig_page_file(state / "rig")), "rig.json");
    for (const RigStep& step : page.steps)
        CHECK((step.verdict == StepVerdict::open) == (step.name != "light"));
}

TEST_CASE("the edges of a serial output are compared with those that a sensor at its lines tells",
          "[session][waits]") {
    Terminal output, sensor;
    std::mutex mutex;
    std::string seen; // by the sensor, and not told yet
    int ups = 0;
    bool is_up = false, is_deaf = false; // to every third edge up
    const TerminalDevice lines(output.master(), [&](std::string_view bytes, double) {
        const std::scoped_lock lock(mutex);
        for (const char byte : bytes) {
            if (is_up == (byte != 0))
                continue; // no edge
            is_up = byte != 0;
            if (!is_up || !is_deaf || ++ups % 3 != 0)
                seen += is_up ? '1' : '0';
        }
        return std::string();
    });
    const TerminalDevice teller(
        sensor.master(), [](std::string_view, double) { return std::string(); },
        [&](double) {
            const std::scoped_lock lock(mutex);
            return std::exchange(seen, {});
        });
    const SmallExperiment experiment(fmt::format(
        "{}\n[[marker_output]]\nid = \"eeg\"\naddress = \"{}\"\npulse_ms = 20\ncodes = [\"onset 10\"]\n",
        small_protocol, output.path()));
    const std::filesystem::path state = experiment.folder().path() / "state";
    const auto markers = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"doctor",    experiment.protocol().string(),
                                     "--json",    "--first-day",
                                     "--step",    "markers",
                                     "--seconds", "0.5"};
        all.insert(all.end(), more.begin(), more.end());
        const ProgramRun run = experiment.overt(all, {"OVERT_STATE=" + state.string()});
        INFO(run.out << run.err);
        const RigPage page = rig_page_from(run.out, "rig.json");
        return *std::ranges::find(page.steps, "markers", &RigStep::name);
    };
    const RigStep unseen = markers({});
    CHECK(unseen.verdict == StepVerdict::not_proved);
    CHECK_THAT(unseen.finding, Contains("No edge was seen of \"eeg\" (no sensor)"));

    // A machine that is too busy answers late, and that is what the step is there to tell: then it is tried
    // again.
    RigStep good = markers({"--marker-sensor", sensor.path()});
    for (int tries = 1; tries < 4 && good.finding.find("each of 20 edges came") == std::string::npos; ++tries)
        good = markers({"--marker-sensor", sensor.path()});
    CAPTURE(good.finding);
    CHECK(good.verdict != StepVerdict::not_proved);
    CHECK_THAT(good.finding, Contains("each of 20 edges came"));
    CHECK(
        std::ranges::find(good.figures, "\"eeg\": edges that nothing raised", &BenchFigure::figure)->value ==
        0.0);

    is_deaf = true;
    const RigStep lossy = markers({"--marker-sensor", sensor.path()});
    CHECK(lossy.verdict == StepVerdict::failed);
    CHECK(std::ranges::find(lossy.figures, "\"eeg\": edges that the sensor did not see", &BenchFigure::figure)
              ->holds == false);
    CHECK_FALSE(lossy.remedy.empty());
}

TEST_CASE("a response box's times are measured by the light that it sees, and named as late or unseen",
          "[session][waits]") {
    const TemporaryFolder framebuffer;
    const auto screen = VirtualScreen::start(544, 192, 24, framebuffer.path().string());
    LightAtPorts light(framebuffer.path());
    const SmallExperiment experiment(
        fmt::format("{}\n[[button_box]]\nid = \"pad\"\nkind = \"xid\"\naddress = \"{}\"\n"
                    "buttons = [\"3 answer left\"]\n",
                    unproven_protocol(), light.box_port()));
    std::vector<std::string> environment = x_server_alone;
    environment.push_back("OVERT_STATE=" + (experiment.folder().path() / "state").string());
    const auto measured = [&](const std::string& name) {
        const ProgramRun run =
            experiment.overt({"doctor", experiment.protocol().string(), "--json", "--first-day", "--step",
                              name, "--windowed", "--sensor", light.sensor_port(), "--seconds", "2"},
                             environment);
        INFO(run.out << run.err);
        REQUIRE_FALSE(run.out.empty());
        const RigPage page = rig_page_from(run.out, "rig.json");
        return *std::ranges::find(page.steps, name, &RigStep::name);
    };
    const auto figure = [](const RigStep& step, const std::string& of) {
        const auto found = std::ranges::find(step.figures, of, &BenchFigure::figure);
        INFO(step.finding);
        REQUIRE(found != step.figures.end());
        return *found;
    };
    // What the display takes is not known yet.
    const RigStep alone = measured("boxes");
    CAPTURE(alone.finding);
    CHECK(alone.verdict != StepVerdict::proved);
    CHECK_THAT(alone.finding, Contains("after the vertical blank, the display's latency included"));

    // The sensor that stands in looks at the framebuffer from a thread: on a machine that is too busy it may
    // see nothing at all, and the light is measured again, as a person would.
    RigStep lit = measured("light");
    for (int again = 0; again < 4 && std::ranges::find(lit.figures, mean_light_figure,
                                                       &BenchFigure::figure) == lit.figures.end();
         ++again)
        lit = measured("light");
    figure(lit, std::string(mean_light_figure));
    const RigStep good = measured("boxes");
    CAPTURE(good.finding);
    // A machine that is too busy looks late, and that is what the step is there to tell.
    CHECK(good.verdict != StepVerdict::not_proved);
    CHECK_FALSE(good.is_simulated);
    CHECK_THAT(good.finding, Contains("\"pad\" (" + light.box_port() + ", product 2, model 2") &&
                                 Contains("after it comes"));
    CHECK(figure(good, "\"pad\": changes that it did not tell").value == 0.0);
    CHECK(figure(good, "\"pad\": edges without a change").value == 0.0);

    light.late_ms = 60;
    const RigStep late = measured("boxes");
    CAPTURE(late.finding);
    CHECK(late.verdict == StepVerdict::failed);
    CHECK(figure(late, "\"pad\": distance of its times from the light, mean").holds == false);
    CHECK_THAT(late.remedy, Contains("latency_timer"));

    light.is_dark = true;
    const RigStep dark = measured("boxes");
    CHECK(dark.verdict == StepVerdict::not_proved);
    CHECK_THAT(dark.finding, Contains("No light came from \"pad\""));
    CHECK_THAT(dark.remedy, Contains("fix a light sensor at each box"));
}

TEST_CASE("trials whose times nothing proves tell no number of missed refreshes, and prove nothing",
          "[session][waits]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    const auto trials = [](std::string_view protocol, const std::vector<std::string>& more) {
        const SmallExperiment experiment(protocol);
        std::vector<std::string> environment = x_server_alone;
        environment.push_back("OVERT_STATE=" + (experiment.folder().path() / "state").string());
        std::vector<std::string> all{
            "doctor", experiment.protocol().string(), "--json", "--first-day", "--step", "trials", "--trials",
            "1",      "--simulate-observer",          "5"};
        all.insert(all.end(), more.begin(), more.end());
        const ProgramRun run = experiment.overt(all, environment);
        INFO(run.out << run.err);
        REQUIRE(run.exit_code == 0);
        // What the session says is not among it.
        REQUIRE(run.out.starts_with("{"));
        const RigPage page = rig_page_from(run.out, "rig.json");
        return *std::ranges::find(page.steps, "trials", &RigStep::name);
    };
    const auto tells_missed = [](const RigStep& step) {
        return std::ranges::find(step.figures, "missed refreshes", &BenchFigure::figure) !=
               step.figures.end();
    };
    const RigStep unproven = trials(unproven_protocol(), {"--windowed"});
    CAPTURE(unproven.finding);
    CHECK(unproven.verdict == StepVerdict::not_proved);
    CHECK_FALSE(tells_missed(unproven));
    CHECK_THAT(unproven.finding, Contains("1 trials of 1 were completed") &&
                                     Contains("how many refreshes were missed is not known"));
    CHECK_THAT(unproven.remedy, Contains("timing = \"proven\""));
    // Times of a display that only keeps time are known.
    CHECK(tells_missed(trials(small_protocol, {"--context", "osmesa"})));
}

TEST_CASE("a step that misses a bound fails the day, and wrong input is refused", "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path state = experiment.folder().path() / "state";
    const std::vector<std::string> environment{"OVERT_STATE=" + state.string()};
    const std::string protocol = experiment.protocol().string();
    // Nothing is to be found at that address.
    const ProgramRun absent =
        experiment.overt({"doctor", protocol, "--first-day", "--step", "stream", "--tracker", "opengaze",
                          "--address", "127.0.0.1:1", "--json"},
                         environment);
    INFO(absent.out << absent.err);
    const auto page = nlohmann::json::parse(absent.out);
    for (const auto& step : page["steps"])
        if (step["step"] == "stream")
            CHECK(step["verdict"] == "not proved");
    // The sensor of a display that is not there cannot be a port.
    const ProgramRun failed = experiment.overt({"doctor", protocol, "--first-day", "--step", "light",
                                                "--sensor", "/dev/null", "--context", "osmesa"},
                                               environment);
    INFO(failed.out << failed.err);
    CHECK(failed.exit_code == 1);
    CHECK_THAT(failed.out, Contains("light      failed") && Contains("a sensor has nothing to see"));

    CHECK(experiment.overt({"doctor", "--first-day"}, environment).exit_code == 2);
    CHECK(experiment.overt({"doctor", protocol, "--first-day", "--step", "lihgt"}, environment).exit_code ==
          2);
    CHECK(experiment.overt({"doctor", protocol, "--anew"}, environment).exit_code == 2);
    std::ofstream(state / "rig/rig.json") << "{}";
    const ProgramRun damaged =
        experiment.overt({"doctor", protocol, "--first-day", "--context", "osmesa"}, environment);
    CHECK(damaged.exit_code == 2);
    CHECK_THAT(damaged.err, Contains("rig.json: is no page of a rig"));
}
