/// A session in real time with a response box and a trigger cable at its serial ports, made of terminals of
/// the kernel: the box presses when the cable says that an animation is over.
#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/devices/link/terminal_device.h"
#include "tests/support/hurried_observer.h"
#include "tests/support/running_program.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

constexpr int trial_code = 1, onset_code = 10, matt_adds = 100, end_code = 3, response_code = 4,
              result_code = 5;
constexpr double press_after_end_s = 0.5;

std::string little_endian(std::uint32_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i)
        bytes += static_cast<char>(value >> (8 * i) & 0xFF);
    return bytes;
}

/// An RB-730 of Cedrus, and what the cable told it.
class CedrusBox {
  public:
    CedrusBox()
        : cable_(std::make_unique<TerminalDevice>(
              cable_line_.master(),
              [this](std::string_view bytes, double now_s) { return told(bytes, now_s); })),
          box_(std::make_unique<TerminalDevice>(
              box_line_.master(),
              [this](std::string_view bytes, double now_s) { return asked(bytes, now_s); },
              [this](double now_s) { return pressed(now_s); })) {}

    const std::string& box_port() const { return box_line_.path(); }
    const std::string& cable_port() const { return cable_line_.path(); }
    std::vector<int> codes() {
        const std::scoped_lock lock(mutex_);
        return codes_;
    }
    std::vector<std::uint32_t> presses_ms() {
        const std::scoped_lock lock(mutex_);
        return presses_ms_;
    }
    /// As pulling their cables.
    void unplug_box() {
        box_.reset();
        box_line_.hang_up();
    }
    void unplug_cable() {
        cable_.reset();
        cable_line_.hang_up();
    }

  private:
    std::string told(std::string_view bytes, double) {
        const std::scoped_lock lock(mutex_);
        for (const char byte : bytes)
            if (byte != 0) {
                codes_.push_back(static_cast<unsigned char>(byte));
                presses_next_ = presses_next_ || codes_.back() == end_code;
            }
        return {};
    }
    std::string asked(std::string_view bytes, double now_s) {
        const std::scoped_lock lock(mutex_);
        heard_ += bytes;
        const auto is = [&](std::string_view command) { return heard_.ends_with(command); };
        if (is("_c1"))
            return "_xid0";
        if (is("_d2") || is("_d3") || is("_d4"))
            return "2";
        if (is("_e5"))
            return "_e5" + little_endian(ms(now_s));
        if (is("e5"))
            zero_s_ = now_s;
        return {};
    }
    /// The second button, down and up.
    std::string pressed(double now_s) {
        const std::scoped_lock lock(mutex_);
        if (presses_next_) {
            presses_next_ = false;
            press_at_s_ = now_s + press_after_end_s;
        }
        if (press_at_s_ == 0.0 || now_s < press_at_s_)
            return {};
        press_at_s_ = 0.0;
        presses_ms_.push_back(ms(now_s));
        const char down = 2 << 5 | 0x10, up = 2 << 5;
        return "k" + std::string(1, down) + little_endian(ms(now_s)) + "k" + std::string(1, up) +
               little_endian(ms(now_s) + 80);
    }
    std::uint32_t ms(double now_s) const { return static_cast<std::uint32_t>((now_s - zero_s_) * 1e3); }

    std::mutex mutex_;
    std::vector<int> codes_;
    std::vector<std::uint32_t> presses_ms_;
    std::string heard_;
    bool presses_next_ = false;
    double press_at_s_ = 0.0, zero_s_ = 0.0;
    Terminal cable_line_, box_line_;
    std::unique_ptr<TerminalDevice> cable_, box_; ///< after what they use
};

std::string protocol_with(const CedrusBox& cedrus) {
    return fmt::format(R"({}
[[button_box]]
id = "pad"
kind = "xid"
address = "{}"
buttons = ["1 answer left", "2 answer right"]

[[marker_output]]
id = "eeg"
address = "{}"
pulse_ms = 2
codes = ["trial 1", "onset 10", "end 3", "response 4", "result 5"]
condition_codes = ["material matt 100"]

[[marker_output]]
id = "stream"
kind = "lsl"

[[marker_output]]
id = "outputs"
kind = "t-lock"
codes = ["onset 1"]
refresh_codes = ["60 4"]
)",
                       small_protocol, cedrus.box_port(), cedrus.cable_port());
}

/// Runs two trials, calling `meanwhile` every few milliseconds.
int run_two_trials(const SmallExperiment& experiment, const std::filesystem::path& said, bool box_answers,
                   const std::function<void()>& meanwhile) {
    std::vector<std::string> options{"run",
                                     experiment.protocol().string(),
                                     "--simulate-observer",
                                     "5",
                                     "--observer",
                                     "P01",
                                     "--context",
                                     "osmesa",
                                     "--seed",
                                     "7",
                                     "--trials",
                                     "2",
                                     "--library",
                                     std::string("lsl=") + OVERT_FAKE_LIBLSL,
                                     "--sessions",
                                     experiment.sessions().string()};
    for (std::string& option : hurried(2, {.response_screens = !box_answers}))
        options.push_back(std::move(option));
    RunningProgram program(options, {"OVERT_CACHE=" + experiment.cache().string()}, said);
    while (program.is_running()) {
        meanwhile();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return program.wait();
}

} // namespace

TEST_CASE("a box answers and a cable is told, and both are in the record and in every export",
          "[session][waits]") {
    CedrusBox cedrus;
    const SmallExperiment experiment(protocol_with(cedrus));
    const std::filesystem::path said = experiment.folder().path() / "said";
    const int code = run_two_trials(experiment, said, true, [] {});
    INFO(text_of(said));
    REQUIRE(code == 0);

    const SessionRecord record(experiment.session());
    REQUIRE(record.trials().size() == 2);
    // On the cable, in their order.
    std::vector<int> expected;
    for (const TrialRecord& trial : record.trials())
        expected.insert(expected.end(),
                        {trial_code, onset_code + (trial.trial.stimulus.material == 1 ? matt_adds : 0),
                         end_code, response_code, result_code});
    CHECK(cedrus.codes() == expected);

    // The presses, by the box's own clock, are the answers.
    const std::vector<RecordedButton> buttons = record.button_changes();
    REQUIRE(buttons.size() == 4);
    REQUIRE(cedrus.presses_ms().size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const TrialRecord& trial = record.trials()[i];
        const RecordedButton& down = buttons[2 * i];
        CHECK(down.is_down);
        CHECK_FALSE(buttons[2 * i + 1].is_down);
        CHECK(down.box == "pad");
        CHECK(down.name == "2");
        CHECK(down.meaning == "answer right");
        CHECK(down.attempt_id == trial.id);
        CHECK(down.device_time == BoxTime(std::chrono::milliseconds(cedrus.presses_ms()[i])));
        CHECK(trial.outcome.responded_at == down.at);
        CHECK(trial.outcome.answer == "right");
        CHECK(trial.response_box == "pad");
        CHECK(trial.response_uncertainty == down.uncertainty);
        CHECK(down.uncertainty > SessionDuration::zero());
    }

    // Each marker at each output, with its refresh.
    long sent_bytes = 0, texts = 0, raised = 0;
    for (const RecordedMarker& marker : record.markers()) {
        CAPTURE(marker.output, marker.text);
        CHECK(marker.attempt_id);
        CHECK(marker.not_before <= marker.not_after);
        sent_bytes += marker.output == "eeg" && marker.is_sent;
        texts += marker.output == "stream" && marker.is_sent;
        if (marker.output == "outputs") {
            ++raised;
            CHECK((marker.text == "SYNCTIME" ? marker.planned_refresh == 0 : marker.planned_refresh == 60));
        }
        if (marker.text == "SYNCTIME") {
            const auto trial = std::ranges::find(record.trials(), *marker.attempt_id, &TrialRecord::id);
            REQUIRE(trial != record.trials().end());
            CHECK(marker.at == trial->outcome.presentation_onset);
        }
    }
    CHECK(sent_bytes == 10);
    CHECK(texts >= 2 * (5 + 30)); // events, variables and frames
    CHECK(raised == 4);
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);

    const auto export_as = [&](const std::string& format) {
        std::filesystem::path out = experiment.folder().path() / ("as_" + format);
        const ProgramRun run = experiment.overt(
            {"export", experiment.session().string(), "--format", format, "--out", out.string()});
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return out;
    };
    const std::filesystem::path tables = export_as("tsv");
    const TsvFile button_table(tables / "buttons.tsv"), marker_table(tables / "markers.tsv"),
        responses(tables / "responses.tsv");
    REQUIRE(button_table.size() == 4);
    CHECK(button_table.text(0, "change") == "down");
    CHECK(button_table.text(0, "used_by") == "observer");
    CHECK(button_table.integer(0, "device_time_us") == 1000L * cedrus.presses_ms()[0]);
    CHECK(marker_table.size() == record.markers().size());
    CHECK(responses.text(0, "answer") == "right");
    CHECK(responses.text(0, "response_box") == "pad");
    CHECK(responses.number(0, "response_uncertainty_s") > 0.0);

    std::string asc, events;
    for (const auto& file : std::filesystem::recursive_directory_iterator(export_as("asc")))
        if (file.path().extension() == ".asc")
            asc += text_of(file.path());
    int button_lines = 0;
    for (std::size_t at = asc.find("\nBUTTON\t"); at != std::string::npos;
         at = asc.find("\nBUTTON\t", at + 1))
        ++button_lines;
    CHECK(button_lines == 4);
    for (const auto& file : std::filesystem::recursive_directory_iterator(export_as("bids")))
        if (file.path().filename().string().ends_with("_events.tsv") &&
            file.path().string().find("physio") == std::string::npos)
            events += text_of(file.path());
    CHECK_THAT(events, Contains("\tbutton\t") && Contains("\tmarker\t"));
}

TEST_CASE("a box and a cable that are unplugged in a trial are data, and the session goes on",
          "[session][waits]") {
    CedrusBox cedrus;
    const SmallExperiment experiment(protocol_with(cedrus));
    const std::filesystem::path said = experiment.folder().path() / "said";
    bool is_gone = false;
    const int code = run_two_trials(experiment, said, false, [&] {
        const std::vector<int> codes = cedrus.codes();
        if (!is_gone && std::ranges::any_of(codes, [](int one) { return one % matt_adds == onset_code; })) {
            cedrus.unplug_box();
            cedrus.unplug_cable();
            is_gone = true;
        }
    });
    const std::string words = text_of(said);
    INFO(words);
    REQUIRE(code == 0);
    CHECK_THAT(words, Contains("the response box \"pad\" does not answer any more") &&
                          Contains("it was gone 1 time"));
    CHECK_THAT(words, Contains(" markers could not be sent: "));
    const SessionRecord record(experiment.session());
    long losses = 0;
    for (const RecordedEvent& event : record.events())
        losses += event.kind == "response box lost";
    CHECK(losses == 1);
    REQUIRE(record.trials().size() == 2);
    for (const TrialRecord& trial : record.trials()) {
        CHECK(trial.counts);
        CHECK(trial.response_box.empty());
    }
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
}

TEST_CASE("a box or a port that is not there refuses the session before it begins, unless it may be left out",
          "[session]") {
    const std::string box =
        "\n[[button_box]]\nid = \"pad\"\nkind = \"xid\"\naddress = \"/dev/no_such_port\"\n";
    const std::string output = "\n[[marker_output]]\nid = \"eeg\"\naddress = \"/dev/no_such_port\"\n"
                               "codes = [\"onset 1\"]\n";
    for (const std::string& device : {box, output}) {
        const SmallExperiment experiment(std::string(small_protocol) + device);
        const ProgramRun refused =
            experiment.overt({"run", experiment.protocol().string(), "--simulate-observer", "5", "--observer",
                              "P01", "--context", "osmesa", "--sessions", experiment.sessions().string()});
        CHECK(refused.exit_code == 1);
        CHECK_THAT(refused.err, Contains("/dev/no_such_port") && Contains("required = false"));
        CHECK_FALSE(std::filesystem::exists(experiment.session()));
        // In virtual time nothing is opened, and it is said.
        const ProgramRun virtual_time = experiment.run({"--trials", "1"});
        CHECK(virtual_time.exit_code == 0);
        CHECK_THAT(virtual_time.out + virtual_time.err, Contains("time is virtual"));
    }
}
