/// A study with something in all that is reckoned: unequal cells, units, lengths and numbers, excluded
/// trials, fixations that do not count, answers of each kind. All of it is drawn from one seed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/study/read/study_reader.h"
#include "tests/experiment/surface/flat_and_round.h"

namespace overt::test {

namespace varied {

inline const std::array<std::string, 3> materials{"smooth", "rough", "matt"};
inline const std::array<std::string, 2> tasks{"free", "age"};

/// How one such study differs from the usual one.
struct Kind {
    int observers = 7;
    double size = 1.0;   ///< of the objects
    double time = 1.0;   ///< of presentations and fixations
    bool is_seen = true; ///< the globe is shown for some time
};

/// An egg of three parts, or of two, in its own unit.
inline void add_object(ReadStudy& study, const std::string& id, double radius, double mm_per_unit, int parts,
                       bool is_seen) {
    auto mesh = std::make_shared<Mesh>(icosphere(radius, 3));
    const auto size = static_cast<float>(radius);
    mesh->part_names = {"body", "head", "nose"};
    mesh->part_names.resize(static_cast<std::size_t>(parts));
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
        const glm::vec3& at = mesh->positions[mesh->triangles[t].x];
        mesh->triangle_parts[t] = parts > 2 && at.y < -0.7f * size ? 2 : at.z > 0.3f * size ? 1 : 0;
    }
    for (glm::vec3& at : mesh->positions)
        at = {at.x, 0.8f * at.y, 1.3f * at.z};
    StudyObject object;
    object.id = id;
    object.title = "The " + id;
    object.part_names = mesh->part_names;
    object.areas = Areas(object.part_names);
    object.mm_per_unit = mm_per_unit;
    object.mm_per_deg = 28.0 * mm_per_unit;
    object.shown_size = 0.7;
    object.screen.screen_px = {1200, 900};
    ObjectSurface surface;
    surface.geometry = std::make_unique<SurfaceGeometry>(*mesh, mm_per_unit);
    surface.areas_mm2 = surface.geometry->vertex_areas_mm2();
    surface.scale = ObjectScale{mm_per_unit, 20.0 * radius, *object.mm_per_deg, 0.7};
    surface.coarse = std::make_unique<CoarseSurface>(*surface.geometry, coarse_nodes, 0.7);
    surface.coarse_geometry = std::make_unique<SurfaceGeometry>(surface.coarse->mesh());
    for (const glm::vec3& at : mesh->positions) {
        // Nothing is seen from behind, and less at the sides.
        const double front = -static_cast<double>(at.y) / radius;
        object.seconds_visible.push_back(
            is_seen && front > -0.2 ? static_cast<float>(2.0 + 5.0 * std::max(front, 0.0)) : 0.0f);
        surface.pixel_seconds.push_back(is_seen && front > -0.2 ? 0.3 + std::max(front, 0.0) : 0.0);
    }
    const int index = static_cast<int>(study.results.objects.size());
    for (int area = -1; area < parts; ++area) {
        ExposureRow row;
        row.object = index;
        row.area = area < 0 ? "" : object.part_names[static_cast<std::size_t>(area)];
        row.area_mm2 = 5000.0 / (2.0 + area);
        row.share_of_area = area < 0 ? 1.0 : 0.6 / (1.0 + area);
        row.share_of_exposure = area < 0 ? 1.0 : 0.5 / (1.0 + area);
        row.never_visible = 0.1 + 0.05 * area;
        row.seconds_visible = 3.0 + area;
        row.foreshortening = 0.5 + 0.1 * area;
        study.results.exposures.push_back(row);
    }
    object.mesh = std::move(mesh);
    study.results.objects.push_back(std::move(object));
    study.surfaces.push_back(std::move(surface));
}

/// Of which there are ready-made maps without a mesh.
inline void add_picture(ReadStudy& study) {
    StudyObject object;
    object.id = "photo";
    object.title = "A photo";
    object.mm_per_unit = 1.5;
    object.mm_per_deg = 40.0;
    object.shown_size = 0.5;
    object.screen.screen_px = {1200, 900};
    study.results.objects.push_back(std::move(object));
    study.surfaces.emplace_back().scale = ObjectScale{1.5, 900.0, 40.0, 0.5};
}

inline StudyFixation fixation_on_picture(RandomStream& random) {
    StudyFixation fixation;
    fixation.duration_s = random.uniform(0.1, 0.4);
    fixation.place = {random.uniform(0.0, 1200.0), random.uniform(0.0, 900.0)};
    fixation.position = {random.uniform(-20.0, 20.0), random.uniform(-30.0, 30.0), 0.0};
    fixation.mm_per_deg = 40.0;
    fixation.sigma_mm = 40.0;
    fixation.samples = 9;
    return fixation;
}

inline StudyFixation fixation_on(const ReadStudy& study, int object, double towards_head,
                                 RandomStream& random) {
    const Mesh& mesh = *study.results.objects[static_cast<std::size_t>(object)].mesh;
    const double unit = *study.results.objects[static_cast<std::size_t>(object)].mm_per_unit;
    StudyFixation fixation;
    fixation.duration_s = random.uniform(0.08, 0.6);
    fixation.place = {random.uniform(200.0, 1000.0), random.uniform(100.0, 800.0)};
    glm::dvec3 way(0.4 * random.normal(), -1.0, towards_head + 0.5 * random.normal());
    std::uint32_t nearest = 0;
    double most = -1e300;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const double along = glm::dot(glm::dvec3(mesh.positions[mesh.triangles[t].x]), glm::normalize(way));
        if (along > most) {
            most = along;
            nearest = t;
        }
    }
    const double a = random.uniform(0.1, 0.5), b = random.uniform(0.1, 0.4);
    fixation.triangle = nearest;
    fixation.barycentric = {a, b, 1.0 - a - b};
    fixation.position = glm::dvec3(0.0);
    for (int corner = 0; corner < 3; ++corner)
        fixation.position +=
            fixation.barycentric[corner] * glm::dvec3(mesh.positions[mesh.triangles[nearest][corner]]);
    fixation.part = mesh.triangle_parts[nearest];
    fixation.samples = 20 + static_cast<int>(random.below(200));
    fixation.on_surface = random.uniform(0.5, 1.0);
    fixation.within_reach = 0.5 * (1.0 - fixation.on_surface);
    fixation.first_frame = static_cast<int>(random.below(20));
    fixation.last_frame = fixation.first_frame + 3;
    fixation.mid_angle_deg = random.uniform(-20.0, 20.0);
    fixation.spread_mm = random.uniform(1.0, 4.0);
    fixation.spread_deg = random.uniform(0.1, 0.4);
    fixation.sigma_mm = unit * random.uniform(24.0, 30.0);
    fixation.mm_per_deg = unit * random.uniform(26.0, 30.0);
    fixation.cone_at_edge = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 0.4);
    fixation.cone_mm = unit * random.uniform(8.0, 16.0);
    fixation.surface_way_deg2 = random.uniform(0.05, 0.4);
    fixation.gaze_with_surface_deg2 = fixation.surface_way_deg2 * random.uniform(0.3, 1.1);
    fixation.displaced_motion = {random.uniform(0.05, 0.3), random.uniform(0.05, 0.4)};
    fixation.surface_deg_s = random.uniform(0.5, 6.0);
    fixation.light = FixationLight{random.normal(), 0.3 * random.normal(), 0.2 * random.normal()};
    fixation.lut_mm = random.uniform(0.01, 0.2);
    const double head = *fixation.part == 1 ? 0.8 : 0.25;
    fixation.evidence = {{1.0 - head, head}, {head, 1.0 - head}};
    if (study.results.objects[static_cast<std::size_t>(object)].part_names.size() > 2)
        fixation.evidence.push_back({random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)});
    return fixation;
}

inline void add_trial(ReadStudy& study, int session, int observer, int number, int task, int object,
                      int material, const Kind& kind, RandomStream& random) {
    StudyResults& results = study.results;
    const int index = static_cast<int>(results.trials.size());
    StudyTrial trial;
    trial.session = session;
    trial.object = object;
    trial.number = number;
    trial.label = fmt::format("observer {}, trial {}",
                              results.sessions[static_cast<std::size_t>(session)].observer, number);
    trial.keys = {{"observer", results.sessions[static_cast<std::size_t>(session)].observer},
                  {"trial", std::to_string(number)},
                  {"task", tasks[static_cast<std::size_t>(task)]},
                  {"object", results.objects[static_cast<std::size_t>(object)].id},
                  {"material", materials[static_cast<std::size_t>(material)]}};
    trial.presentation_s = kind.time * (3.0 + 0.25 * (index % 5));
    trial.first_fixation = results.fixations.size();
    trial.clock_uncertainty_s = random.uniform(0.0005, 0.004);
    trial.excluded = index % 17 == 5;
    if (trial.excluded)
        trial.why_excluded = "2 refreshes were missed.";
    trial.quality.accuracy_deg = random.uniform(0.2, 0.8);
    trial.quality.worst_accuracy_deg = 2.0 * *trial.quality.accuracy_deg;
    trial.quality.rms_s2s_deg = random.uniform(0.02, 0.2);
    trial.quality.sd_deg = random.uniform(0.05, 0.3);
    trial.quality.rate_hz = 500.0;
    trial.quality.samples = 1500.0 + index;
    trial.quality.lost = 3.0 * (index % 7);
    trial.quality.lost_in_blinks = 2.0 * (index % 4);
    trial.quality.refreshes = 360 + index;
    trial.quality.missed_refreshes = trial.excluded ? 2 : 0;
    for (int frame = 0; frame < 90; ++frame)
        trial.turns.push_back({frame / 30.0, 20.0 * std::sin(0.1 * frame), frame % 60});
    const double towards_head = 0.5 * task + 0.35 * (material == 1) - 0.2 * (material == 2) +
                                0.1 * ((observer % 3) - 1) + 0.15 * object;
    const int count = 3 + static_cast<int>(random.below(7));
    double at_s = random.uniform(-0.05, 0.2);
    for (int i = 0; i < count; ++i) {
        // Rough ones draw gaze to the head at first, and away from it at the end.
        const double soon = material == 1 ? 1.0 - at_s / kind.time : 0.0;
        StudyFixation fixation = object == 2 ? fixation_on_picture(random)
                                             : fixation_on(study, object, towards_head + soon, random);
        fixation.duration_s *= kind.time;
        fixation.trial = index;
        fixation.onset_s = at_s;
        at_s += fixation.duration_s + kind.time * random.uniform(0.02, 0.08);
        const std::uint64_t fate = random.below(20);
        if (trial.excluded)
            fixation.why = NotCounted::trial_excluded;
        else if (fixation.onset_s < 0.0)
            fixation.why = NotCounted::began_before_onset;
        else if (fate == 0)
            fixation.why = NotCounted::too_short;
        else if (fate == 1) {
            fixation.why = NotCounted::not_on_surface;
            fixation.triangle.reset();
            fixation.part.reset();
        } else if (fate == 2)
            fixation.only_by_reach = true;
        else if (fate == 3) {
            fixation.evidence.clear();
            fixation.light.reset();
            fixation.displaced_motion.reset();
            fixation.lut_mm.reset();
        }
        results.fixations.push_back(std::move(fixation));
        ++trial.fixations;
    }
    results.screen_areas.push_back(
        {{"left", ScreenArea::Shape::rectangle, {{0.0, 0.0}, {600.0, 900.0}}},
         {"middle", ScreenArea::Shape::ellipse, {{400.0, 300.0}, {900.0, 700.0}}, 0.5, 2.0}});
    results.trials.push_back(std::move(trial));
}

/// The last trials of each observer show both eggs side by side.
inline void add_pair(ReadStudy& study, int session, int observer, int number, const Kind& kind,
                     RandomStream& random) {
    for (const int object : {0, 1}) {
        add_trial(study, session, observer, number, 0, object, number % 2, kind, random);
        study.results.trials.back().keys.push_back({"slot", object == 0 ? "left" : "right"});
    }
}

inline StudyAnswer answer_to(const StudyResults& results, const StudyTrial& trial, const std::string& id,
                             const std::string& kind) {
    StudyAnswer answer;
    answer.observer = results.sessions[static_cast<std::size_t>(trial.session)].observer;
    answer.task = trial.key("task");
    answer.answer = id;
    answer.kind = kind;
    answer.is_missed = false;
    answer.session = trial.session;
    answer.trial = trial.number;
    answer.levels = {{"object", trial.key("object")}, {"material", trial.key("material")}};
    answer.shown = {{"", answer.levels, {}, 2.0 + 0.1 * (trial.number % 5)}};
    return answer;
}

inline void add_answers(StudyResults& results, RandomStream& random) {
    std::set<std::pair<int, int>> pairs;
    for (const StudyTrial& trial : results.trials) {
        if (trial.key("slot") == "n/a" || !pairs.emplace(trial.session, trial.number).second)
            continue;
        StudyAnswer which;
        which.observer = results.sessions[static_cast<std::size_t>(trial.session)].observer;
        which.task = "free";
        which.answer = "which";
        which.kind = "choice";
        which.is_missed = false;
        which.session = trial.session;
        which.trial = trial.number;
        which.value = random.uniform() < 0.6 ? "left" : "right";
        which.response_s = random.uniform(0.5, 2.0);
        for (const char* const slot : {"left", "right"}) {
            const double size = random.uniform(1.0, 3.0);
            which.shown.push_back({slot,
                                   {{"size", fmt::format("{:.1f}", size)}},
                                   {{"size", size}},
                                   1.0 + 0.3 * (trial.number % 4)});
        }
        results.answers.given.push_back(std::move(which));
    }
    for (const StudyTrial& trial : results.trials) {
        if (trial.key("slot") != "n/a")
            continue;
        StudyAnswer metal = answer_to(results, trial, "metal", "choice");
        metal.correct = trial.number % 3 == 0 ? "no" : "yes";
        metal.value = random.uniform() < 0.75 ? metal.correct : metal.correct == "no" ? "yes" : "no";
        metal.is_correct = metal.value == metal.correct;
        metal.response_s = random.uniform(0.4, 1.9);
        metal.is_missed = trial.number % 13 == 6;
        results.answers.given.push_back(metal);
        StudyAnswer sure = answer_to(results, trial, "sure", "scale");
        sure.number =
            1.0 + static_cast<double>(random.below(5)) + (trial.key("material") == "rough" ? 1.0 : 0.0);
        sure.value = fmt::format("{}", *sure.number);
        sure.response_s = random.uniform(0.3, 1.2);
        results.answers.given.push_back(sure);
        AnsweredPointRow point;
        point.of = {metal.observer, metal.task, "spot", trial.object};
        point.session = trial.session;
        point.trial = trial.number;
        point.by = trial.number % 2 == 0 ? "mouse" : "gaze";
        const StudyFixation& at = results.fixations[trial.first_fixation];
        if (at.triangle) {
            point.place = at.position;
            point.triangle = at.triangle;
            point.part = at.part;
            point.barycentric = at.barycentric;
            point.part_name = results.objects[static_cast<std::size_t>(trial.object)].part_names[*at.part];
            point.largest_sd = 1.5;
        }
        results.points.given.push_back(point);
        point.of.answer = "other";
        const StudyFixation& later = results.fixations[trial.first_fixation + trial.fixations - 1];
        if (later.triangle && at.triangle) {
            point.place = later.position;
            point.triangle = later.triangle;
            point.part = later.part;
            point.barycentric = later.barycentric;
            results.points.given.push_back(point);
        }
        if (trial.number % 2 == 0)
            results.explorations.shows.push_back({metal.observer,
                                                  trial.session,
                                                  trial.number,
                                                  1,
                                                  {{"material", trial.key("material")}},
                                                  trial.presentation_s,
                                                  random.uniform(0.5, 2.0),
                                                  random.uniform(10.0, 300.0),
                                                  random.uniform(-90.0, 90.0),
                                                  static_cast<int>(random.below(5)),
                                                  3 + static_cast<int>(random.below(20))});
    }
}

/// Of a ball that lies 800 before the camera, with errors.
inline void add_gauges(StudyResults& results, int observers, RandomStream& random) {
    for (int observer = 0; observer < std::min(observers, 3); ++observer)
        for (int i = 0; i < 40; ++i)
            for (int again = 0; again < 2; ++again) {
                const double turn = 2.4 * i, flat = 0.12 * std::sqrt(static_cast<double>(i));
                const glm::dvec3 normal =
                    glm::normalize(glm::dvec3(flat * std::cos(turn), flat * std::sin(turn), 1.0));
                GaugeSettingRow& row = results.reliefs.settings.emplace_back();
                row.of = {fmt::format("o{}", observer + 1), "free", "lean", "egg", "smooth", "", "", "", 3};
                row.session = observer;
                row.trial = i + 1;
                row.point = fmt::format("p.{}", i + 1);
                row.x = 100.0 * normal.x;
                row.y = 100.0 * normal.y;
                row.z = 100.0 * normal.z - 800.0;
                row.truth = attitude_of(normal);
                const double gain = 0.7 + 0.1 * observer;
                row.set = attitude_of({gain * normal.x / normal.z + 0.05 + 0.03 * random.normal(),
                                       gain * normal.y / normal.z + 0.03 * random.normal(), 1.0});
                row.is_at_limit = row.set.slant.value > 45.0;
                row.response_s = random.uniform(0.5, 3.0);
            }
}

} // namespace varied

/// Seven observers, of whom the second came twice; two eggs and a picture, two tasks, three materials.
inline ReadStudy varied_study(const varied::Kind& kind = {}) {
    ReadStudy study;
    StudyResults& results = study.results;
    study.levels = {{"task", {"free", "age"}},
                    {"object", {"egg", "globe", "photo"}},
                    {"material", {"smooth", "rough", "matt"}}};
    varied::add_object(study, "egg", 50.0, 2.0 * kind.size, 3, true);
    varied::add_object(study, "globe", 80.0, 1.25 * kind.size, 2, kind.is_seen);
    varied::add_picture(study);
    RandomStream random(11, "varied study");
    for (int observer = 0; observer < kind.observers; ++observer) {
        int number = 0;
        for (int sitting = 0; sitting < (observer == 1 ? 2 : 1); ++sitting) {
            StudySession& session = results.sessions.emplace_back();
            session.observer = fmt::format("o{}", observer + 1);
            session.folder = fmt::format("sub-{}_ses-{}", session.observer, sitting + 1);
            session.number = sitting + 1;
            session.protocol = "Eggs";
            session.is_complete = observer != 3;
            session.trials = 9;
            session.setup.gaze.rate_hz = 500.0;
            StudyQuality& quality = results.session_quality.emplace_back();
            quality.samples = 9000.0 + observer;
            const int index = static_cast<int>(results.sessions.size()) - 1;
            if (observer % 2 == 0)
                varied::add_trial(study, index, observer, ++number, observer / 2 % 2, 2, 0, kind, random);
            for (int task = 0; task < 2; ++task)
                for (int object = 0; object < 2; ++object)
                    for (int material = 0; material < 3; ++material) {
                        // Not everybody sees everything, and some things are seen twice.
                        if ((observer + 2 * task + 3 * object + 5 * material + sitting) % 7 == 0)
                            continue;
                        const int times = (observer + task + material) % 4 == 1 ? 2 : 1;
                        for (int again = 0; again < times; ++again)
                            varied::add_trial(study, index, observer, ++number, task, object, material, kind,
                                              random);
                    }
            // Of the fourth there is one alone.
            for (int pair = 0; pair < (observer == 3 ? 1 : 5); ++pair)
                varied::add_pair(study, index, observer, ++number, kind, random);
        }
    }
    varied::add_answers(results, random);
    varied::add_gauges(results, kind.observers, random);
    return study;
}

} // namespace overt::test
