/// What simulated observers answer, press, turn and say with a seed stays what it is: sums of whole trials,
/// to a millionth.
#include <catch2/catch.hpp>

#include <cmath>

#include <fmt/format.h>

#include "devices/simulated/simulated_answer_recorder.h"
#include "devices/simulated/simulated_keys.h"
#include "devices/simulated/simulated_response_panel.h"
#include "devices/simulated/simulated_turns.h"
#include "devices/simulated/simulated_voice.h"
#include "experiment/answers/answer_kinds.h"
#include "tests/devices/simulated/sitting.h"
#include "tests/support/counted_clock.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

using Figures = std::vector<double>;

void check_figures(const Figures& found, const Figures& known) {
    std::string all;
    for (const double number : found)
        all += fmt::format("{:.9g}, ", number);
    INFO(all);
    CHECK(found.size() == known.size());
    for (std::size_t i = 0; i < std::min(found.size(), known.size()); ++i) {
        CAPTURE(i);
        CHECK(found[i] == Approx(known[i]).epsilon(1e-6).margin(1e-7));
    }
}

AnswerKind answer_kind_named(std::string_view name) {
    std::size_t kind = 0;
    while (kinds_of<AnswerKind>[kind].name != name)
        ++kind;
    return static_cast<AnswerKind>(kind);
}

/// Four materials of which each has a level, three slots, and answers with all that a truth can have.
Protocol judged_protocol() {
    Protocol protocol;
    for (const char* const id : {"left", "right", "middle"})
        protocol.slots.emplace_back().id = id;
    for (const char* const id : {"bust", "cow"})
        protocol.objects.emplace_back().id = id;
    for (int i = 0; i < 4; ++i) {
        auto& material = protocol.materials.emplace_back();
        material.id = fmt::format("gold_{}", i);
        material.columns = {{"gloss", fmt::format("{}", i), 1.0 * i}};
    }
    Task task;
    task.id = "judge";
    task.slots = {"left", "right"};
    TaskAnswer which;
    which.id = "which";
    which.kind = answer_kind_named("choice");
    which.choices = {"left", "right"};
    which.keys = {"f", "j"};
    which.truth.by = "gloss";
    which.truth.slope = 0.4;
    which.truth.bias = 0.2;
    which.truth.observer_sd = 0.3;
    which.truth.lapses = 0.1;
    which.truth.look_share = 0.7;
    which.truth.look_area = "head";
    which.truth.look_odds = 3.0;
    which.truth.time_by = "gloss";
    which.truth.time_gain_s = 0.25;
    which.truth.shift_s = 0.1;
    TaskAnswer word = which;
    word.id = "word";
    word.choices = {"matt", "silky", "glossy"};
    word.keys = {"a", "b", "c"};
    word.truth.offset = 1.0;
    word.truth.look_share.reset();
    TaskAnswer steps;
    steps.id = "steps";
    steps.kind = answer_kind_named("scale");
    steps.steps = 7;
    steps.truth.by = "gloss";
    steps.truth.offset = 2.5;
    steps.truth.gain = 1.2;
    steps.truth.noise = 0.8;
    steps.truth.early = 0.3;
    steps.truth.missing = 0.2;
    steps.truth.late = 0.3;
    TaskAnswer right;
    right.id = "right";
    right.kind = answer_kind_named("choice");
    right.choices = {"metal", "stone", "glass"};
    right.keys = {"a", "b", "c"};
    right.correct = "stone";
    right.truth.share_correct = 0.6;
    task.answers = {which, word, steps, right};
    protocol.tasks = {task};
    SimulatedEffect effect;
    effect.entries[0] = "cow";
    effect.answer = "which";
    effect.answer_shift = 0.6;
    SimulatedEffect other;
    other.answer = "right";
    other.answer_odds = 2.5;
    other.entries[0] = "bust";
    SimulatedEffect steeper;
    steeper.answer = "steps";
    steeper.answer_slope = 1.5;
    steeper.answer_shift = -0.3;
    protocol.simulated_effects = {effect, other, steeper};
    return protocol;
}

Trial judged_trial(int index) {
    Trial trial;
    trial.index = index;
    trial.stimulus.material = index % 4;
    trial.stimulus.object = index % 2;
    trial.beside = {{{index / 2 % 2, (index + 2) % 4, 0, 0, 0}, 1}};
    return trial;
}

/// Sums over inputs, each with a weight of its own.
Figures sums_of(const std::vector<ObserverInput>& inputs) {
    Figures sums(7, 0.0);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const ObserverInput& input = inputs[i];
        const double weight = 1.0 + 0.01 * static_cast<double>(i);
        double letters = 0.0;
        for (const char letter : input.key.view())
            letters = 1.1 * letter + letters;
        sums[0] += 1.0;
        sums[1] += weight * to_seconds(input.at.time_since_epoch());
        sums[2] += weight * (1.0 + static_cast<double>(input.kind));
        sums[3] += weight * (letters + static_cast<double>(input.character));
        sums[4] += weight * input.right_px;
        sums[5] += weight * input.down_px;
        sums[6] += weight * input.button;
    }
    return sums;
}

std::vector<ObserverInput> all_inputs(SimulatedKeys& keys) {
    std::vector<ObserverInput> inputs;
    for (SessionTime now{}; now < SessionTime(40s); now += 10ms)
        while (const auto input = keys.next(now))
            inputs.push_back(*input);
    return inputs;
}

} // namespace

TEST_CASE("what a simulated observer means to answer with a seed stays what it was", "[unit]") {
    const Protocol protocol = judged_protocol();
    const SimulatedAnswers answers(protocol, 31);
    Figures all;
    for (const std::size_t which : {0, 1, 2, 3}) {
        const TaskAnswer& answer = protocol.tasks[0].answers[which];
        Figures found(8, 0.0);
        for (int i = 0; i < 40; ++i) {
            const Trial trial = judged_trial(i);
            AnswerOffer offer = offer_of(protocol, answer, "", trial);
            if (which == 2)
                offer.limit_s = 3.0;
            const SimulatedAnswers::Intended given = answers.answer(offer, trial);
            const double weight = 1.0 + 0.1 * i;
            found[0] += weight * to_seconds(given.after);
            found[1] += weight * given.choice;
            found[2] += weight * given.number.value_or(-1.0);
            found[3] += weight * (given.is_early + 2.0 * given.is_missing + 4.0 * given.is_late);
            const auto expected = answers.expected(offer, trial);
            for (std::size_t k = 0; k < expected.shares.size(); ++k)
                found[4] += weight * static_cast<double>(k + 1) * expected.shares[k];
            found[5] += weight * expected.mean.value_or(0.0);
            const GazeFavour favour = answers.favour_of(trial, {"plinth", "head"});
            found[6] += weight * (favour.slot + favour.share + favour.odds);
            found[7] += weight * favour.area;
        }
        all.insert(all.end(), found.begin(), found.end());
    }
    check_figures(all, {135.355703, 5.8,   -118,  0,   130.147259, 0,          64.4, -53.6,
                        132.962828, 122.4, -118,  0,   234.480685, 0,          64.4, -53.6,
                        209.096205, 0,     579.2, 251, 0,          565.783042, 64.4, -53.6,
                        109.6088,   128.4, -118,  0,   236,        0,          64.4, -53.6});
}

TEST_CASE("the odd one out, and answers that are set or leaned, stay what they were with a seed", "[unit]") {
    Protocol protocol = judged_protocol();
    TaskAnswer& odd = protocol.tasks[0].answers[0];
    odd.kind = answer_kind_named(odd_one_out_kind);
    odd.choices = {"left", "right", "middle"};
    odd.keys = {"a", "b", "c"};
    const SimulatedAnswers answers(protocol, 32);
    Figures found(6, 0.0);
    for (int i = 0; i < 40; ++i) {
        Trial trial = judged_trial(i);
        trial.beside.push_back({{1, (i + 1) % 4, 0, 0, 0}, 2});
        const double weight = 1.0 + 0.1 * i;
        const AnswerOffer offer = offer_of(protocol, odd, "", trial);
        found[0] += weight * answers.answer(offer, trial).choice;
        found[1] += weight * answers.expected(offer, trial).shares.back();
        AnswerOffer set;
        set.id = "steps";
        set.kind = "match";
        OfferedAxis axis;
        for (int k = 0; k <= 100; ++k)
            axis.values.push_back(0.1 * k);
        axis.start = 90;
        axis.reference = 0.2 * (i % 10);
        set.axes = {axis, axis};
        set.axes[1].reference.reset();
        const std::vector<int> at = answers.answer(set, trial).at;
        REQUIRE(at.size() == 2);
        found[2] += weight * at[0];
        found[3] += weight * at[1];
        AnswerOffer gauge;
        gauge.id = "steps";
        gauge.kind = "gauge";
        gauge.attitude = Attitude{Degrees{10.0}, Degrees{20.0}};
        gauge.true_attitude = Attitude{Degrees{30.0}, Degrees{9.0 * i}};
        const auto lean = answers.answer(gauge, trial).attitude;
        REQUIRE(lean);
        found[4] += weight * lean->slant.value;
        found[5] += weight * lean->tilt.value;
    }
    check_figures(found, {126.2, 49.0866483, 4708.8, 2693.8, 4840.64184, 19689.2472});
}

TEST_CASE("the keys and drags of a simulated observer stay what they were with a seed", "[unit]") {
    const Protocol protocol = judged_protocol();
    const SimulatedAnswers answers(protocol, 33);
    std::vector<AnswerOffer> offers;
    const auto offer = [&](std::string id, std::string kind) -> AnswerOffer& {
        AnswerOffer& added = offers.emplace_back();
        added.id = std::move(id);
        added.kind = std::move(kind);
        return added;
    };
    AnswerOffer& choice = offer("right", "choice");
    choice.values = {"metal", "stone", "glass"};
    choice.keys = {"a", "b", "c"};
    choice.correct = "stone";
    AnswerOffer& number = offer("steps", "scale");
    number.numbers = {1, 2, 3, 4, 5, 6, 7};
    number.values = number.keys = {"1", "2", "3", "4", "5", "6", "7"};
    number.low = 1.0;
    number.high = 7.0;
    number.step = 1.0;
    number.accept_key = "enter";
    AnswerOffer& line = offer("steps", "scale");
    line.item = "line";
    line.low = 0.0;
    line.high = 60.0;
    line.step = 0.5;
    line.accept_key = "enter";
    AnswerOffer& turned = offer("none", "scale");
    turned.low = 0.0;
    turned.high = 10.0;
    turned.step = 1.0;
    turned.is_turned = true;
    offer("typed", "number").low = 2.0;
    offer("words", "text").accept_key = "enter";
    offer("place", "point");
    offer("gaze", "point").keys = {"space"};
    AnswerOffer& set = offer("steps", "match");
    OfferedAxis axis;
    for (int k = 0; k <= 100; ++k)
        axis.values.push_back(0.1 * k);
    axis.start = 80;
    axis.coarse = 5;
    axis.less = "left";
    axis.more = "right";
    axis.much_less = "down";
    axis.much_more = "up";
    axis.reference = 1.0;
    set.axes = {axis, axis, axis};
    set.axes[1].start = 3;
    set.axes[1].much_less.clear();
    set.axes[2].less.clear();
    AnswerOffer& gauge = offer("none", "gauge");
    gauge.attitude = Attitude{Degrees{10.0}, Degrees{20.0}};
    gauge.true_attitude = Attitude{Degrees{30.0}, Degrees{100.0}};
    gauge.slant_per_px_deg = 0.25;
    gauge.accept_key = "space";
    Figures found;
    for (int i = 0; i < 8; ++i)
        for (const AnswerOffer& one : offers) {
            SimulatedKeys keys;
            keys.let_gaze_guide([](SessionTime at) { return glm::dvec2(10.0 * to_seconds(at), -5.0); });
            keys.plan(answers, {one}, judged_trial(i));
            keys.awaited(SessionTime(1s));
            keys.window_opened(SessionTime(2s));
            const Figures sums = sums_of(all_inputs(keys));
            double all = 0.0;
            for (std::size_t k = 0; k < sums.size(); ++k)
                all += static_cast<double>(k + 1) * sums[k];
            found.push_back(all);
        }
    check_figures(found, {889.195953, 5379.74838, 74325.3859, 12682.3203, 215.425357, 6809.13783, 523.477377,
                          4656.35772, 293214.742, 3019.56385, 881.665928, 5395.16871, 84317.0308, 12681.2656,
                          215.267339, 6805.13458, 497.295611, 4657.72918, 285238.797, 3018.68923, 892.526595,
                          448.6578,   84312.1791, 12681.8858, 215.652399, 6812.53692, 405.030438, 4657.30444,
                          0,          3019.20351, 880.505116, 5415.76289, 60625.2546, 12680.7302, 215.1293,
                          6813.63423, 320.120451, 4656.88759, 395077.389, 3018.24523, 892.484103, 448.6578,
                          0,          12684.0542, 215.252366, 6808.94253, 350.490935, 4656.22197, 0,
                          3021.00169, 890.116515, 5940.80933, 0,          12680.2797, 215.826236, 6807.56477,
                          531.638969, 4655.79077, 374853.594, 3017.87168, 888.634565, 5966.11487, 69882.604,
                          12681.744,  215.544673, 6808.44647, 341.194623, 4660.53544, 358378.405, 3019.08597,
                          897.442334, 5968.80824, 65229.1185, 12681.3824, 215.11746,  6807.85243, 426.859145,
                          4655.99635, 395160.011, 3018.78608});
    // Several, one after the other.
    SimulatedKeys keys;
    keys.plan(answers, offers, judged_trial(5));
    keys.awaited(SessionTime(1s));
    keys.window_opened(SessionTime(2s));
    check_figures(sums_of(all_inputs(keys)),
                  {137, 3047.57482, 391.56, 119883.865, -279.308466, -480.526746, 9.44});
}

TEST_CASE("how a simulated observer turns an object stays what it was with a seed", "[unit]") {
    Figures found;
    for (const bool by_keys : {false, true})
        for (const bool tilts : {false, true}) {
            TurningOffer offer;
            offer.since = SessionTime(3s);
            offer.lasts_s = 12.0;
            offer.drags_tilt = tilts;
            offer.is_elevation = by_keys && tilts;
            offer.deg_per_px = 0.5;
            offer.right_px = 100.0;
            offer.down_px = -40.0;
            offer.turn_sd_deg = 30.0;
            offer.pause_s = 0.5;
            offer.speed_deg_s = 45.0;
            if (by_keys) {
                offer.less = "left";
                offer.more = "right";
            }
            SimulatedTurns turns;
            turns.plan(9, judged_trial(2), offer);
            std::vector<ObserverInput> inputs;
            while (const auto input = turns.next(SessionTime(60s)))
                inputs.push_back(*input);
            const Figures sums = sums_of(inputs);
            found.insert(found.end(), sums.begin(), sums.end());
        }
    check_figures(found, {329, 7815.06752, 3600.54, 0,         94052.0178, -34742.4,    868.56,
                          422, 12753.447,  5333.66, 0,         134845.182, -34132.4656, 1310.31,
                          24,  249.69929,  40.2,    14805.692, 0,          0,           0,
                          18,  165.665797, 29.34,   10235.841, 0,          0,           0});
}

TEST_CASE("the voice and the words of a simulated observer stay what they were with a seed", "[unit]") {
    SimulatedVoice voice;
    voice.begin_s = 0.2;
    voice.end_s = 0.9;
    const std::vector<float> sound = simulated_sound(voice, 8000.0, 1.0, 3);
    REQUIRE(sound.size() == 8000);
    Figures found(3, 0.0);
    for (std::size_t i = 0; i < sound.size(); ++i) {
        const auto value = static_cast<double>(sound[i]);
        found[0] += value * static_cast<double>(i % 97);
        found[1] += value * value;
        found[2] += i < 1600 || i >= 7200 ? std::abs(value) : 0.0;
    }
    SimulatedSitting sitting(41);
    for (int i = 0; i < 6; ++i) {
        const SimulatedAnswer answer = sitting.observer.answer_to({i, i % 2, {}});
        found.push_back(to_seconds(answer.after));
        found.push_back(to_seconds(answer.voice_after));
        found.push_back(to_seconds(answer.voice_until));
        found.push_back(static_cast<double>(answer.text.size()));
        found.push_back(to_seconds(sitting.observer.reading_time(i)));
    }
    check_figures(found,
                  {16.834534,   15.8692154,  1.94106732,  3.21483094,  0.481432509, 2.91483094,  5,
                   2.52014223,  4.92251494,  0.564539002, 4.62251494,  18,          2.82098098,  4.53516191,
                   0.659596493, 4.23516191,  16,          1.83103301,  11.2404118,  0.661056385, 10.9404118,
                   26,          2.21330188,  3.58870479,  0.733426264, 3.28870479,  5,           2.89225425,
                   9.0033735,   0.316537937, 8.7033735,   18,          1.58867201});

    const TemporaryFolder folder;
    CountedClock clock;
    SimulatedSoundSettings settings;
    settings.sample_rate_hz = 8000;
    settings.clock_drift_ppm = 50.0;
    settings.gain = 2.0;
    SimulatedAnswerRecorder recorder(clock, sitting.observer, 5, settings);
    recorder.keep_in(folder.path());
    const auto recording = recorder.begin({4, 0, {}});
    const double quiet = static_cast<double>(recording->level().peak);
    clock.time += 500ms;
    recording->response_screen_lit(clock.time);
    const SimulatedAnswer said = sitting.observer.answer_to({4, 0, {}});
    clock.time += said.voice_after;
    CHECK(recording->level().peak == 0.6f);
    CHECK(recording->level().rms == Approx(0.18));
    CHECK_FALSE(recording->level().is_clipping);
    clock.time += said.voice_until - said.voice_after - 1ns;
    CHECK(recording->level().peak == 0.6f);
    clock.time += 1ns;
    CHECK(static_cast<double>(recording->level().peak) == quiet);
    CHECK(quiet == Approx(std::pow(10.0, settings.noise_dbfs / 20.0)));
    settings.gain = 10.0 / 3.0; // as loud as can be
    SimulatedAnswerRecorder loud(clock, sitting.observer, 5, settings);
    const auto clipped = loud.begin({4, 0, {}});
    clipped->response_screen_lit(clock.time);
    clock.time += said.voice_after;
    CHECK(clipped->level().peak == 1.0f);
    CHECK(clipped->level().is_clipping);
    clock.time -= said.voice_after;
    clock.time += 300ms;
    recording->end(clock.time);
    const RecordedAnswer answer = recording->result().value();
    CHECK(answer.trial == 4);
    CHECK(answer.fault.empty());
    check_figures({static_cast<double>(answer.samples), answer.onset_sample, answer.measured_rate_hz,
                   1e3 * to_seconds(answer.onset_uncertainty), answer.peak_dbfs,
                   answer.voice_onset ? to_seconds(*answer.voice_onset - said.voice_after) : -1.0,
                   answer.voice_end ? to_seconds(*answer.voice_end - said.voice_until) : -1.0},
                  {32711, 3999.27315, 8000.78803, 0.224812, -3.4226057, 0.001592191, 6.2109e-05});
}
