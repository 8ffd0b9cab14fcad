/// A study with something in each of its tables, made up.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "experiment/study/answers/answer_results.h"
#include "experiment/study/results/study_results.h"
#include "tests/experiment/surface/flat_and_round.h"

namespace overt::test {

namespace made_up {

inline StudyObject object(const std::string& id, double radius) {
    StudyObject made;
    auto mesh = std::make_shared<Mesh>(icosphere(radius, 3));
    made.id = id;
    made.title = fmt::format("The {}", id);
    made.part_names = {"body", "head"};
    made.areas = Areas(made.part_names);
    made.camera = fit_camera(*mesh, Degrees{12.0}, {1024, 1024}, Degrees{25.0}, 0.05);
    made.mm_per_unit = 1.0;
    for (const glm::vec3& position : mesh->positions) {
        made.seconds_visible.push_back(position.y > 0.3f * static_cast<float>(radius) ? 0.0f : 8.0f);
        made.exposure_density.push_back(1e-4f);
    }
    made.mesh = std::move(mesh);
    return made;
}

inline StudyMap map(const StudyResults& study, int group, int on, MapWeighting weighting, double height) {
    StudyMap made;
    made.group = group;
    made.object = on;
    made.weighting = weighting;
    const Mesh& mesh = *study.objects[static_cast<std::size_t>(on)].mesh;
    const double radius = glm::length(mesh.positions.front());
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 away =
            glm::dvec3(position) / radius - glm::normalize(glm::dvec3(0.2 * group, -1.0, height));
        made.density.push_back(static_cast<float>((1.0 + group) * std::exp(-4.0 * glm::dot(away, away))));
        made.peak = std::max<double>(made.peak, made.density.back());
    }
    made.observers = 3;
    made.trials = 6;
    made.fixations = 80;
    made.least_sigma_mm = 28.5;
    made.most_sigma_mm = 31.0;
    made.euclidean_leak = 0.042;
    made.error.accuracy_mm = 12.0;
    made.error.together_mm = 12.5;
    made.error.near_edge = 0.1;
    return made;
}

inline void add_trial(StudyResults& study, int number) {
    StudyTrial trial;
    trial.object = number % 2;
    trial.label = fmt::format("observer 01, trial {}", number + 1);
    trial.number = number + 1;
    trial.keys = study.groups[static_cast<std::size_t>(number)].keys;
    trial.presentation_s = 8.0;
    if (number == 3) {
        trial.excluded = true;
        trial.why_excluded = "More than half of its samples were lost.";
    }
    for (int frame = 0; frame < 240; ++frame)
        trial.turns.push_back(
            {frame / 30.0, 25.0 * std::sin(2.0 * std::numbers::pi * frame / 60.0), frame % 60});
    trial.first_fixation = study.fixations.size();
    trial.fixations = 20;
    StudyTrace trace;
    trace.trial = number;
    const Mesh& mesh = *study.objects[static_cast<std::size_t>(trial.object)].mesh;
    const auto place = [number](int at) {
        return ScreenPoint{960.0 + 100.0 * std::sin(at + number), 540.0 + 120.0 * std::cos(1.3 * at)};
    };
    for (int i = 0; i < 20; ++i) {
        StudyFixation fixation;
        fixation.trial = number;
        fixation.onset_s = 0.4 * i;
        fixation.duration_s = 0.2 + 0.005 * i;
        fixation.place = place(i);
        fixation.triangle = static_cast<std::uint32_t>(i * 61 % 1280);
        fixation.position = mesh.positions[mesh.triangles[*fixation.triangle].x];
        fixation.part = PartIndex{0};
        if (i % 7 == 3)
            fixation.why = NotCounted::too_short;
        trace.events.push_back({GazeEvent::Kind::fixation, fixation.onset_s, fixation.duration_s});
        trace.events.push_back({GazeEvent::Kind::saccade, fixation.onset_s + fixation.duration_s, 0.04,
                                2.0 + i, 100.0 + 20.0 * i});
        study.fixations.push_back(fixation);
        for (int k = 0; k < 100; ++k) {
            const double moved = std::clamp((0.004 * k - fixation.duration_s) / 0.04, 0.0, 1.0);
            StudyTracePoint point{fixation.onset_s + 0.004 * k, std::nullopt, 1000.0f};
            if (i != 9 || k > 30)
                point.gaze = ScreenPoint{std::lerp(place(i).x_px, place(i + 1).x_px, moved),
                                         std::lerp(place(i).y_px, place(i + 1).y_px, moved)};
            trace.points.push_back(point);
        }
    }
    study.traces.push_back(std::move(trace));
    study.trials.push_back(std::move(trial));
}

/// Choices between two slots, ratings, and choices of which one is right, of three observers.
inline void add_answers(StudyResults& study) {
    for (int observer = 0; observer < 3; ++observer)
        for (int trial = 0; trial < 48; ++trial) {
            StudyAnswer answer;
            answer.observer = fmt::format("0{}", observer + 1);
            answer.task = "glossier";
            answer.trial = trial + 1;
            answer.is_missed = false;
            answer.kind = "choice";
            answer.answer = "which";
            const double levels[] = {0.05, 0.1, 0.2, 0.4};
            const double left = levels[trial % 4], right = levels[(trial / 4 + 1) % 4];
            answer.shown = {{"left", {{"roughness", fmt::format("{}", left)}}, {{"roughness", left}}},
                            {"right", {{"roughness", fmt::format("{}", right)}}, {{"roughness", right}}}};
            answer.levels = {{"object", trial % 2 == 0 ? "ball" : "globe"}};
            answer.value = (trial * 7 + observer) % 10 < (left < right ? 8 : 2) ? "left" : "right";
            answer.response_s = 0.4 + 0.01 * ((trial * 13 + observer) % 40);
            study.answers.given.push_back(answer);
            answer.answer = "metal";
            answer.shown.resize(1);
            answer.levels = answer.shown.front().levels;
            answer.correct = trial % 3 == 0 ? "yes" : "no";
            answer.value = (trial * 11 + observer) % 9 < 6 ? answer.correct : "yes";
            answer.is_correct = answer.value == answer.correct;
            answer.procedure = "stairs </script>";
            answer.procedure_factor = "roughness";
            answer.track = 1;
            study.answers.given.push_back(answer);
            answer.answer = "sure";
            answer.kind = "scale";
            answer.correct = "";
            answer.is_correct = std::nullopt;
            answer.procedure = "";
            answer.number = 1 + (trial + observer) % 4;
            answer.value = fmt::format("{}", *answer.number);
            study.answers.given.push_back(std::move(answer));
        }
    StudyOptions options;
    options.resamples = 100;
    reckon_answers(study.answers, options);
    for (const char* const measure : {"dwell share", "last look"}) {
        GazeChoiceRow row;
        row.of = {"", "glossier", "which", ""};
        row.measure = measure;
        row.value = Estimate::of(0.61, Interval{0.55, 0.67});
        row.chance = 0.5;
        row.p = 0.03;
        row.observers = 3;
        row.of_observers = {0.58, 0.6, 0.65};
        study.answers.gaze_choices.push_back(row);
        row.area = "head";
        row.a = "chosen";
        row.b = "not chosen";
        row.value = Estimate::of(-0.04, Interval{-0.1, 0.02});
        study.answers.gaze_choices.push_back(std::move(row));
    }
    study.answer_maps = study.differences;
    study.answer_maps.front().column = "which";
    study.answer_maps.front().a = "chosen";
    study.answer_maps.front().b = "not chosen";
    DifferenceMap absent;
    absent.keys = {{"task", "glossier"}};
    absent.object = 1;
    absent.column = "which";
    absent.a = "chosen";
    absent.b = "not chosen";
    absent.absent = "one observer alone gave both answers";
    study.answer_maps.push_back(std::move(absent));
    study.headline = {"Which of the two is glossier?", "144 trials; what differs is roughness (4 levels).",
                      "N = 3 simulated observers, none left out; 1 trial excluded.",
                      "On the scale of roughness 0.05 lies highest, at 1.1 (95 % interval 0.7 to 1.5)."};
}

} // namespace made_up

/// Two tasks, two objects, two materials. Its texts try to break out of the page.
inline StudyResults made_up_study() {
    StudyResults study;
    study.glance = {"A </script><script>throw 1</script> study",
                    3,
                    3,
                    4,
                    1,
                    64000,
                    80,
                    68,
                    0,
                    {{NotCounted::too_short, 12}},
                    14.0,
                    true};
    study.remarks = {"One session has <b>another</b> protocol.", "{{DATA}} </script> <!-- <script>"};
    study.by = {"task", "object", "material"};
    study.parameters = {{"sigma", "1", "deg", "The kernel's standard deviation is 1 degree."}};
    StudySession session;
    session.folder = "sub-01_ses-01";
    session.observer = "01";
    session.setup.gaze.origin = GazeOrigin::simulated;
    session.setup.gaze.tracker = "simulated";
    session.events = "Fixations are those that the tracker told.";
    study.sessions.push_back(session);
    study.session_quality.push_back({});
    study.objects = {made_up::object("ball", 50.0), made_up::object("globe", 80.0)};
    for (const std::string task : {"free", "age"}) {
        for (const int on : {0, 1}) {
            for (const std::string material : {"smooth", "rough"}) {
                const auto group = static_cast<int>(study.groups.size());
                const std::string& id = study.objects[static_cast<std::size_t>(on)].id;
                study.groups.push_back({{{"task", task}, {"object", id}, {"material", material}}, {}, 3, 40});
                const double height = task == "free" ? 0.3 : 0.9;
                for (const MapWeighting weighting : {MapWeighting::duration, MapWeighting::count})
                    study.maps.push_back(made_up::map(study, group, on, weighting, height));
                DistributionRow row;
                row.group = group;
                row.object = on;
                row.wss_mm2 = Estimate::of(500.0 + 20.0 * group, Interval{400.0, 700.0});
                row.wss_deg2 = Estimate::of(0.5);
                row.variance_mm2 = {100.0, 200.0, 200.0 + 20.0 * group};
                study.distributions.push_back(row);
                study.area_rows.push_back({.area = "head",
                                           .keys = study.groups.back().keys,
                                           .by_count = Estimate::of(0.3 + 0.05 * group, Interval{0.2, 0.8}),
                                           .by_duration = Estimate::none("one observer only"),
                                           .corrected = Estimate::of(0.33 + 0.05 * group, Interval{0.2, 0.9}),
                                           .pooled = 0.31,
                                           .pooled_interval = {},
                                           .planted = {},
                                           .observers = 3,
                                           .trials = 6,
                                           .fixations = 40,
                                           .of_observers = {0.2, 0.25 + 0.05 * group, 0.45}});
            }
        }
        study.area_rows.push_back({.area = "head",
                                   .keys = {{"task", task}},
                                   .by_count = Estimate::of(0.4, Interval{0.3, 0.5}),
                                   .by_duration = {},
                                   .corrected = {},
                                   .pooled = 0.4,
                                   .pooled_interval = {},
                                   .planted = {},
                                   .observers = 3,
                                   .trials = 6,
                                   .fixations = 40});
        for (int second = 0; second < 8; ++second)
            study.time_course.push_back({"head",
                                         {"task", task},
                                         1.0 * second,
                                         second + 1.0,
                                         Estimate::of(0.3 + 0.02 * second, Interval{0.2, 0.6}),
                                         3});
    }
    study.maps.back().density.clear();
    study.maps.back().absent = "No fixation was counted.";
    PairRow pair;
    pair.column = "material";
    pair.a = "rough";
    pair.b = "smooth";
    pair.wss_difference_mm2 = Estimate::of(11.4, Interval{-3.0, 26.0});
    pair.cc.value = Estimate::of(0.35, Interval{0.3, 0.4});
    pair.cc.other_level = Estimate::of(0.27);
    pair.cc.same_level = Estimate::of(0.29, Interval{0.25, 0.33});
    pair.cc.level_effect = Estimate::of(0.02, Interval{-0.01, 0.05});
    pair.maps_cc = 0.71;
    pair.maps_p = 0.0004;
    pair.maps_p_holm = 0.0012;
    pair.sim_mit.value = Estimate::none("no visible vertex");
    study.pairs.push_back(pair);
    DifferenceMap difference;
    difference.column = "material";
    difference.a = "rough";
    difference.b = "smooth";
    for (std::size_t v = 0; v < study.maps[0].density.size(); ++v)
        difference.difference.push_back(study.maps[0].density[v] - study.maps[2].density[v]);
    difference.cluster.assign(difference.difference.size(), 0);
    std::fill_n(difference.cluster.begin(), 60, std::uint16_t{1});
    difference.clusters.push_back({30.0, 12.0, {1.0, 2.0, 3.0}, PartIndex{1}, 0.04, 0.03, 0.06});
    difference.observers = 6;
    difference.least_p = 1.0 / 32.0;
    study.differences.push_back(difference);
    made_up::add_answers(study);
    MapPredictionRow prediction;
    prediction.nss = Estimate::of(1.2, Interval{0.8, 1.5});
    prediction.kl = Estimate::none("no other observer has fixations there");
    study.predictions.push_back(prediction);
    MapReliabilityRow reliability;
    reliability.reliability = Estimate::of(0.8, Interval{0.6, 0.9});
    study.reliabilities.push_back(reliability);
    study.areas = study.compared_areas = {"body", "head"};
    study.area = "head";
    study.surface_transitions.push_back({{},
                                         "body",
                                         "head",
                                         Estimate::of(0.3, Interval{0.2, 0.4}),
                                         Estimate::of(0.35, Interval{0.3, 0.4}),
                                         Estimate::of(-0.05, Interval{-0.1, 0.0}),
                                         3,
                                         120,
                                         400});
    study.area_pairs.push_back({"head",
                                {},
                                "material",
                                "rough",
                                "smooth",
                                Estimate::of(0.07, Interval{0.01, 0.13}),
                                0.02,
                                0.04,
                                0.04,
                                {},
                                3,
                                6});
    study.effects.push_back({"share on head", "task", 0.4, 0.002, 0.004, 0.0002, 12, {}});
    study.effects.push_back({"log WSS", "task:material", {}, {}, {}, {}, 0, "there is one level alone"});
    study.motions.push_back(
        {{}, Estimate::of(0.9, Interval{0.7, 1.1}), Estimate::of(0.95), Estimate::of(1.6), 3, 70});
    study.motions.push_back(
        {{{"material", "smooth"}}, Estimate::of(-0.1, Interval{-0.3, 0.1}), {}, Estimate::of(1.5), 3, 30});
    study.motions.push_back(
        {{{"material", "rough"}}, Estimate::none("no counted fixation saw the surface move"), {}, {}, 0, 0});
    study.reporting.push_back({"1 eye tracker", "eyes measured", "right <i>", true});
    study.reporting.push_back({"4 recording environment", "room", "not recorded: describe both", false});
    study.methods.push_back({"Stimuli", "What was <i>shown</i> & asked is {{DATA}}. It was so."});
    study.exposures.push_back({0, "all", 31400.0, 1.0, 0.35, 4.0, 1.0, 0.5, 1.0});
    study.exposures.push_back({0, "head", 3140.0, 0.1, 0.2, 5.0, 0.12, std::nullopt, 0.4});
    for (int trial = 0; trial < 4; ++trial)
        made_up::add_trial(study, trial);
    return study;
}

} // namespace overt::test
