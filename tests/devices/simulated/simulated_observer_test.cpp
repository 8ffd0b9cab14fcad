#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiment/events/main_sequence.h"
#include "tests/devices/simulated/sitting.h"

using namespace overt;
using namespace std::chrono_literals;
using test::degrees_between;
using test::SimulatedSitting;

namespace {

constexpr SessionDuration sample_period = 500us;

bool is_head(const SimulatedSitting& sitting, const SurfacePoint& point) {
    return sitting.mesh.part_names[point.part] == "head";
}

double distance_px(ScreenPoint a, ScreenPoint b) { return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px); }

/// Where a point of the object is on the screen in a frame.
ScreenPoint shown_at(const SimulatedSitting& sitting, const SurfacePoint& point, AnimationFrameIndex frame) {
    const ObservedScene& scene = sitting.observer.scene();
    const SceneView& view = scene.objects[0].scene;
    const glm::dmat4 turn = view.pose_at(scene.animations[0].object_in(frame)).world_from_object();
    return scene.screen.screen_from_image(
        view.view.project(glm::dvec3(turn * glm::dvec4(point.position, 1.0))));
}

/// Casts the line of sight of a place on the screen at the object in a frame.
std::optional<RayHit> cast(const SimulatedSitting& sitting, const RayCaster& caster, ScreenPoint place,
                           AnimationFrameIndex frame) {
    const ObservedScene& scene = sitting.observer.scene();
    const SceneView& view = scene.objects[0].scene;
    return caster.first_hit(to_object(view.view.ray_through(scene.screen.image_from_screen(place)),
                                      view.pose_at(scene.animations[0].object_in(frame))));
}

template <class Visit> void for_each_sample(const SimulatedSitting& sitting, const Visit& visit) {
    const SessionTime end = sitting.onset() + 8s;
    for (SessionTime time = sitting.onset(); time < end; time += sample_period)
        visit(time);
}

} // namespace

TEST_CASE("an observer's share of fixation time on the head is the task's", "[unit]") {
    SimulatedSitting sitting(42);
    for (const int task : {0, 1}) {
        double on_head_s = 0.0, in_all_s = 0.0;
        int fixations = 0;
        for (int trial = 0; trial < 100; ++trial) {
            const int index = 100 * task + trial;
            sitting.present({index, task, {}});
            for (const ScriptedFixation& fixation : sitting.observer.script_of(index)->fixations()) {
                if (!fixation.target || fixation.end > 8s)
                    continue;
                const double length_s = to_seconds(fixation.end - fixation.begin);
                in_all_s += length_s;
                on_head_s += is_head(sitting, *fixation.target) ? length_s : 0.0;
                ++fixations;
            }
        }
        const double expected = sitting.observer.scene().tasks[std::size_t(task)].shares[0];
        // Four standard errors; durations differ, and so count as fewer than there are.
        const double bound = 4.0 * std::sqrt(expected * (1.0 - expected) * 1.3 / fixations);
        CHECK(fixations > 2000);
        CHECK(std::abs(on_head_s / in_all_s - expected) < bound);
    }
}

TEST_CASE("the surface under the gaze gives the head's share back", "[unit]") {
    SimulatedSitting sitting(43);
    double on_head = 0.0, on_surface = 0.0, meant_for_head = 0.0;
    for (int trial = 0; trial < 8; ++trial) {
        sitting.present({trial, 0, {}});
        for_each_sample(sitting, [&](SessionTime time) {
            const GazeTruth truth = sitting.observer.truth_at(time);
            if (!truth.target || !truth.surface)
                return;
            on_surface += 1.0;
            on_head += is_head(sitting, *truth.surface);
            meant_for_head += is_head(sitting, *truth.target);
        });
    }
    CHECK(on_surface > 8 * 8000);
    CHECK(on_head / on_surface == Approx(meant_for_head / on_surface).margin(0.01));
}

TEST_CASE("halfway through a lit frame the eye is exactly on its target in that frame", "[unit]") {
    SimulatedSitting sitting(44, test::without_wandering());
    const RayCaster caster(sitting.mesh);
    const ObservedScene& scene = sitting.observer.scene();
    int met = 0;
    for (int trial = 0; trial < 4; ++trial) {
        sitting.present({trial, 0, {}});
        for (const ScriptedFixation& fixation : sitting.observer.script_of(trial)->fixations()) {
            if (!fixation.target)
                continue;
            for (int step = 0; step < scene.animations[0].shown_frame_count(); ++step) {
                const SessionDuration middle =
                    from_seconds((step + 0.5) / scene.animations[0].frame_rate_hz) + fixation.light_delay;
                if (middle < fixation.begin || middle >= fixation.end)
                    continue;
                const GazeTruth truth = sitting.observer.truth_at(sitting.onset() + middle);
                if (truth.gaze.state == EyeState::blink)
                    continue;
                const AnimationFrameIndex frame = scene.animations[0].frame_at_step(step);
                REQUIRE(truth.frame == frame);
                REQUIRE(distance_px(truth.gaze.place, shown_at(sitting, *fixation.target, frame)) < 1e-3);
                const std::optional<RayHit> hit = cast(sitting, caster, truth.gaze.place, frame);
                REQUIRE(hit.has_value());
                REQUIRE(glm::length(hit->position - fixation.target->position) < 1e-3);
                ++met;
            }
        }
    }
    CHECK(met > 4 * 150);
}

TEST_CASE("the surface under the gaze is that of the frame really lit, missed refreshes included", "[unit]") {
    SimulatedSitting sitting(45, test::without_wandering());
    const RayCaster caster(sitting.mesh);
    sitting.present({0, 0, {}}, {3, 100, 101, 102, 480, 700});
    int checked = 0, between_steps = 0;
    double farthest_off_px = 0.0;
    for_each_sample(sitting, [&](SessionTime time) {
        const GazeTruth truth = sitting.observer.truth_at(time);
        if (!truth.frame || !truth.surface)
            return;
        const AnimationFrameIndex frame = sitting.frame_lit(time, truth.gaze.place.y_px);
        REQUIRE(*truth.frame == frame);
        const std::optional<RayHit> hit = cast(sitting, caster, truth.gaze.place, frame);
        REQUIRE(hit.has_value());
        REQUIRE(hit->triangle == truth.surface->triangle);
        REQUIRE(hit->position == truth.surface->position);
        ++checked;
        if (truth.target) {
            const double off_px = distance_px(truth.gaze.place, shown_at(sitting, *truth.target, frame));
            farthest_off_px = std::max(farthest_off_px, off_px);
            between_steps += off_px > 1.0;
        }
    });
    CHECK(checked > 12000);
    CHECK(between_steps > 100); // the eye goes smoothly, the picture in steps
    // A point 62 mm before the axis goes 2.8 mm in the largest step (25 deg 2 pi / 60), which is 8.6 px; half
    // of that, and as much again while a missed refresh keeps an old frame.
    CHECK(farthest_off_px > 2.0);
    CHECK(farthest_off_px < 8.6);
}

TEST_CASE("what a fixation is meant for is visible in every frame lit meanwhile", "[unit]") {
    SimulatedSitting sitting(46);
    const RayCaster caster(sitting.mesh);
    const ObservedScene& scene = sitting.observer.scene();
    const SceneView& view = scene.objects[0].scene;
    sitting.present({0, 0, {}});
    int checked = 0;
    for (const ScriptedFixation& fixation : sitting.observer.script_of(0)->fixations()) {
        if (!fixation.target || fixation.end > 8s)
            continue;
        for (SessionDuration time = fixation.begin; time < fixation.end; time += 5ms) {
            const AnimationFrameIndex frame = *sitting.observer.truth_at(sitting.onset() + time).frame;
            const glm::dvec3 eye = to_object({view.view.camera.position, {0.0, 1.0, 0.0}},
                                             view.pose_at(scene.animations[0].object_in(frame)))
                                       .origin;
            REQUIRE_FALSE(caster.is_hidden(fixation.target->position, eye));
            ++checked;
        }
    }
    CHECK(checked > 500);
}

TEST_CASE("the same seed looks at the same places and another seed elsewhere", "[unit]") {
    SimulatedSitting one(7), same(7), other(8);
    for (SimulatedSitting* sitting : {&one, &same, &other})
        sitting->present({5, 0, {}});
    int alike = 0, compared = 0;
    for_each_sample(one, [&](SessionTime time) {
        const GazeTruth truth = one.observer.truth_at(time), again = same.observer.truth_at(time);
        REQUIRE(truth.gaze.place == again.gaze.place);
        REQUIRE(truth.gaze.state == again.gaze.state);
        REQUIRE(truth.surface.has_value() == again.surface.has_value());
        if (truth.surface)
            REQUIRE(truth.surface->position == again.surface->position);
        alike += distance_px(truth.gaze.place, other.observer.gaze_at(time).place) < 1.0;
        ++compared;
    });
    CHECK(alike < compared / 20);
}

TEST_CASE("a trial's scanpath depends on the trial and not on those before it", "[unit]") {
    SimulatedSitting in_order(9), out_of_order(9);
    for (const int trial : {0, 1, 2})
        in_order.present({trial, 0, {}});
    for (const int trial : {2, 0})
        out_of_order.present({trial, 0, {}});
    const auto targets = [](const SimulatedSitting& sitting, int trial) {
        std::vector<std::uint32_t> triangles;
        for (const ScriptedFixation& fixation : sitting.observer.script_of(trial)->fixations())
            triangles.push_back(fixation.target ? fixation.target->triangle : 0);
        return triangles;
    };
    CHECK(targets(in_order, 2) == targets(out_of_order, 2));
    CHECK(targets(in_order, 0) == targets(out_of_order, 0));
    CHECK(targets(in_order, 0) != targets(in_order, 1));
}

TEST_CASE("saccades follow the main sequence and the gaze never jumps", "[unit]") {
    SimulatedSitting sitting(47, test::without_wandering());
    const ObservedScene& scene = sitting.observer.scene();
    int saccades = 0;
    double fastest_deg_per_s = 0.0;
    for (int trial = 0; trial < 5; ++trial) {
        sitting.present({trial, 0, {}});
        TrueGaze before = sitting.observer.gaze_at(sitting.onset());
        for_each_sample(sitting, [&](SessionTime time) {
            const TrueGaze gaze = sitting.observer.gaze_at(time);
            const double speed = degrees_between(scene, before.place, gaze.place) / to_seconds(sample_period);
            fastest_deg_per_s = std::max(fastest_deg_per_s, speed);
            if (gaze.state == EyeState::fixation && before.state == EyeState::fixation)
                REQUIRE(speed < 8.0); // pursuit alone
            before = gaze;
        });
        const std::vector<ScriptedFixation>& fixations = sitting.observer.script_of(trial)->fixations();
        for (std::size_t i = 1; i < fixations.size() && fixations[i].begin < 8s; ++i) {
            const SessionDuration begin = fixations[i - 1].end, length = fixations[i].begin - begin;
            const auto at = [&](double share) {
                return sitting.observer
                    .gaze_at(sitting.onset() + begin + from_seconds(share * to_seconds(length)))
                    .place;
            };
            const double size_deg = degrees_between(scene, at(0.0), at(1.0));
            // The object turns on meanwhile, hence the tolerance.
            CHECK(to_seconds(length) == Approx(0.021 + 0.0022 * size_deg).margin(0.001));
            const double peak = degrees_between(scene, at(0.45), at(0.55)) / (0.1 * to_seconds(length));
            CHECK(peak == Approx(1.86 * size_deg / to_seconds(length)).epsilon(0.1).margin(4.0));
            ++saccades;
        }
    }
    CHECK(saccades > 100);
    CHECK(fastest_deg_per_s > 150.0);
    CHECK(fastest_deg_per_s < 600.0);
}

TEST_CASE("fixations last as long as set, about 250 ms", "[unit]") {
    SimulatedSitting sitting(48);
    std::vector<double> lengths_s;
    for (int trial = 0; trial < 40; ++trial) {
        sitting.present({trial, 0, {}});
        const std::vector<ScriptedFixation>& fixations = sitting.observer.script_of(trial)->fixations();
        for (std::size_t i = 1; i < 20; ++i)
            lengths_s.push_back(to_seconds(fixations[i].end - fixations[i].begin));
    }
    std::sort(lengths_s.begin(), lengths_s.end());
    CHECK(lengths_s.front() >= 0.08);
    CHECK(lengths_s.back() <= 1.5);
    CHECK(lengths_s[lengths_s.size() / 2] == Approx(0.25).margin(0.02));
}

TEST_CASE("blinks come twelve times a minute and last 100 to 200 ms", "[unit]") {
    const BlinkTrain blinks(3, 12.0);
    int count = 0, closed_ms = 0;
    double shortest_s = 1.0, longest_s = 0.0, since_s = 0.0;
    bool was_closed = false;
    for (int ms = 0; ms < 600'000; ++ms) {
        const bool closed = blinks.eye_closed_at(SessionTime(std::chrono::milliseconds(ms)));
        closed_ms += closed;
        if (closed && !was_closed) {
            ++count;
            since_s = 1e-3 * ms;
        } else if (!closed && was_closed) {
            shortest_s = std::min(shortest_s, 1e-3 * ms - since_s);
            longest_s = std::max(longest_s, 1e-3 * ms - since_s);
        }
        was_closed = closed;
    }
    CHECK(count == 120);
    CHECK(shortest_s > 0.098);
    CHECK(longest_s < 0.202);
    CHECK(closed_ms == Approx(120 * 150).epsilon(0.1));
    CHECK_FALSE(BlinkTrain(3, 0.0).eye_closed_at(SessionTime(1s)));
}

TEST_CASE("the eye wanders by as much as set", "[unit]") {
    const FixationalMotion motion(5, {0.03}, {0.002});
    const FixationalMotion still(5, {0.0}, {0.0});
    double sum = 0.0, sum_of_squares = 0.0;
    const int count = 400'000;
    for (int i = 0; i < count; ++i) {
        const SessionTime time(i * 500us);
        const double x = motion.displacement_deg(time).x;
        sum += x;
        sum_of_squares += x * x;
        REQUIRE(still.displacement_deg(time) == glm::dvec2(0.0));
    }
    CHECK(sum / count == Approx(0.0).margin(0.002));
    CHECK(std::sqrt(sum_of_squares / count) == Approx(std::hypot(0.03, 0.002)).epsilon(0.05));
}

TEST_CASE("before and after a presentation the observer looks at the middle of the screen", "[unit]") {
    SimulatedSitting sitting(49, test::without_wandering());
    const ScreenPoint centre = sitting.observer.scene().screen.centre();
    CHECK(sitting.observer.gaze_at(SessionTime(400ms)).place == centre);
    sitting.present({0, 0, {}});
    const SessionTime end = sitting.onset() + 8s;
    CHECK(sitting.observer.gaze_at(sitting.onset() - 1ms).place == centre);
    CHECK(sitting.observer.gaze_at(end + 600ms).place == centre);
    CHECK_FALSE(sitting.observer.truth_at(end + 600ms).target.has_value());
    // In between it goes there without a jump.
    ScreenPoint before = sitting.observer.gaze_at(end - 1ms).place;
    CHECK(distance_px(before, centre) > 1.0);
    for (SessionTime time = end - 1ms; time < end + 600ms; time += sample_period) {
        const ScreenPoint place = sitting.observer.gaze_at(time).place;
        REQUIRE(degrees_between(sitting.observer.scene(), before, place) < 600.0 * to_seconds(sample_period));
        before = place;
    }
}

TEST_CASE("an object of which only pictures exist is looked at within the picture", "[unit]") {
    const Mesh mesh = test::bust();
    ObservedScene scene = test::scene_with(mesh);
    scene.objects[0].mesh = nullptr;
    SimulatedObserver observer(scene, 1, test::without_wandering());
    observer.presentation_begins({0, 0, {}}, 0);
    FlipRecord flip;
    flip.report.vertical_blank = SessionTime(1s);
    observer.flipped(flip);
    ScreenPoint last = scene.screen.centre();
    int places = 0;
    for (SessionTime time(1s); time < SessionTime(9s); time += 1ms) {
        const GazeTruth truth = observer.truth_at(time);
        REQUIRE(scene.screen.is_inside_image(scene.screen.image_from_screen(truth.gaze.place)));
        REQUIRE_FALSE(truth.surface.has_value());
        if (truth.gaze.state == EyeState::fixation && distance_px(last, truth.gaze.place) > 20.0) {
            ++places;
            last = truth.gaze.place;
        }
    }
    CHECK(places > 10);
}

TEST_CASE("between two targets the eye is on its way, evenly about the middle of it, and then stays",
          "[unit]") {
    SimulatedSitting sitting(4, test::without_wandering());
    const ScreenPoint centre = sitting.observer.scene().screen.centre(),
                      there{centre.x_px + 400.0, centre.y_px - 300.0};
    Screen screen;
    screen.kind = Screen::Kind::target;
    screen.target_place = there;
    const SessionTime onset(std::chrono::seconds(10));
    sitting.observer.screen_shown(screen, onset);
    const auto share_at = [&](SessionDuration after) {
        const TrueGaze gaze = sitting.observer.gaze_at(onset + after);
        const double share = (gaze.place.x_px - centre.x_px) / 400.0;
        CHECK((gaze.place.y_px - centre.y_px) / -300.0 == Approx(share).margin(1e-9));
        return share;
    };
    using namespace std::chrono_literals;
    CHECK(share_at(-1s) == 0.0);
    CHECK(share_at(200ms) == Approx(0.0).margin(1e-9));
    const SessionDuration way =
        saccade_duration(sitting.observer.scene().screen.angle_between(centre, there));
    CHECK(share_at(200ms + way / 2) == Approx(0.5).margin(0.01));
    CHECK(share_at(200ms + way / 4) + share_at(200ms + 3 * way / 4) == Approx(1.0).margin(0.01));
    CHECK(share_at(200ms + way / 4) < 0.4);
    CHECK(share_at(200ms + way) == Approx(1.0));
    CHECK(share_at(5s) == Approx(1.0));
}

namespace {

/// Pictures of 400 x 400 px at these places from the left, each in a slot of its own; nothing is known of
/// what they show.
ObservedScene pictures_at(const std::vector<int>& left_px) {
    ObservedScene scene;
    scene.animations[0].duration_s = 0.2;
    scene.screen.image_px = {400, 400};
    for (const int left : left_px) {
        scene.slots.push_back(scene.screen);
        scene.slots.back().image_origin_px = {left, 340};
    }
    scene.objects.resize(1);
    scene.tasks = {{"free", {0.4}}};
    return scene;
}

Trial trial_of_pictures(std::size_t count, int index = 0) {
    Trial trial;
    trial.index = index;
    for (std::size_t i = 1; i < count; ++i)
        trial.beside.push_back({{}, static_cast<int>(i)});
    return trial;
}

void flip_at(SimulatedObserver& observer, SessionTime at, int frame = 0) {
    FlipRecord flip;
    flip.report.vertical_blank = at;
    flip.shown = AnimationFrameIndex{frame};
    observer.flipped(flip);
}

} // namespace

TEST_CASE("a slot that is favoured gets its share of the fixations, and the others the rest alike",
          "[unit]") {
    for (const std::size_t count : {1u, 2u, 3u})
        for (const int favoured : {-1, 0, 1}) {
            CAPTURE(count, favoured);
            const std::vector<int> places{100, 700, 1300};
            SimulatedObserver observer(
                pictures_at({places.begin(), places.begin() + static_cast<int>(count)}), 3);
            observer.let_answers_guide([&](const Trial&) { return GazeFavour{favoured, 0.8}; });
            std::array<double, 3> often{};
            double all = 0.0;
            for (int index = 0; index < 300; ++index) {
                observer.presentation_begins(trial_of_pictures(count, index), 0);
                const auto& fixations = observer.script_of(index)->fixations();
                for (std::size_t i = 1; i < fixations.size(); ++i, all += 1.0)
                    often.at(fixations[i].shown) += 1.0;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                const double even = 1.0 / static_cast<double>(count);
                const double rest = 0.2 / (static_cast<double>(count) - 1.0);
                const double known = i >= count                        ? 0.0
                                     : favoured < 0 || count == 1      ? even
                                     : static_cast<int>(i) == favoured ? 0.8
                                                                       : rest;
                CHECK(often[i] / all == Approx(known).margin(0.035));
            }
        }
}

TEST_CASE("of pictures over each other the last one is seen, with the frame that it has", "[unit]") {
    SimulatedObserver observer(pictures_at({760, 760}), 3, test::without_wandering());
    observer.presentation_begins(trial_of_pictures(2), 0);
    for (int flip = 0; flip < 3; ++flip) {
        flip_at(observer, SessionTime(1s) + flip * 500ms, flip);
        observer.slot_flipped({0, 0, 1, {}, AnimationFrameIndex{10 + flip}, {}});
        observer.slot_flipped({0, 0, 1, {}, AnimationFrameIndex{99}, {}}); // one more than there can be
    }
    for (int flip = 0; flip < 3; ++flip) {
        const GazeTruth truth = observer.truth_at(SessionTime(1100ms) + flip * 500ms);
        CHECK(truth.frame == AnimationFrameIndex{10 + flip});
        CHECK(truth.shown == std::size_t{1});
        CHECK(truth.slot == 1);
    }
}

TEST_CASE(
    "after a show the eye stays 150 ms, ends the saccade that is under way, and then goes to the middle",
    "[unit]") {
    const ObservedScene scene = pictures_at({300});
    const ScreenPoint centre = scene.screen.centre();
    const auto shown_until = [&](SessionTime end) {
        auto observer = std::make_unique<SimulatedObserver>(scene, 3, test::without_wandering());
        observer->presentation_begins(trial_of_pictures(1), 0);
        flip_at(*observer, SessionTime(1s));
        observer->screen_shown({}, end);
        return observer;
    };
    // Longer than anybody planned: the eye has rested at the last place.
    const auto long_shown = shown_until(SessionTime(20s));
    const ScreenPoint last = long_shown->script_of(0)->fixations().back().place;
    CHECK(distance_px(last, centre) > 1.0);
    CHECK(long_shown->gaze_at(SessionTime(20149ms)).place == last);
    CHECK_FALSE(long_shown->gaze_at(SessionTime(20165ms)).place == last);
    CHECK(long_shown->gaze_at(SessionTime(20400ms)).place == centre);
    // In the middle of a fixation, and of a saccade.
    const std::vector<ScriptedFixation> fixations = long_shown->script_of(0)->fixations();
    const ScriptedFixation& before = fixations[2];
    const ScriptedFixation& after = fixations[3];
    const SessionTime onset(1s);
    const SessionTime middle = onset + (before.begin + before.end) / 2;
    const auto fixating = shown_until(middle - 150ms);
    CHECK(fixating->gaze_at(middle - 1ms).place == before.place);
    CHECK_FALSE(fixating->gaze_at(middle + 15ms).place == before.place);
    const auto moving = shown_until(onset + before.end + 1ms - 150ms);
    const SessionTime arrived = onset + after.begin;
    CHECK(moving->gaze_at(arrived).place == after.place);
    CHECK(moving->gaze_at(arrived + 19ms).place == after.place);
    CHECK_FALSE(moving->gaze_at(arrived + 35ms).place == after.place);
    CHECK(moving->gaze_at(arrived + 300ms).place == centre);
}

TEST_CASE("of several things side by side each is seen with the frames that it had, in its slot", "[unit]") {
    const std::vector<int> places{100, 700, 1300};
    ObservedScene scene = pictures_at(places);
    scene.animations[0].duration_s = 3.0;
    SimulatedObserver observer(scene, 3, test::without_wandering());
    observer.presentation_begins(trial_of_pictures(3), 0);
    constexpr int flips = 300;
    for (int flip = 0; flip < flips; ++flip) {
        flip_at(observer, SessionTime(1s) + flip * 8ms, flip);
        for (const int slot : {1, 2})
            observer.slot_flipped({0, flip, slot, {}, AnimationFrameIndex{1000 * slot + flip}, {}});
    }
    std::array<int, 3> seen{};
    for (int flip = 0; flip < flips; ++flip) {
        const GazeTruth truth = observer.truth_at(SessionTime(1s) + flip * 8ms + 7ms);
        if (!truth.slot) {
            CHECK(truth.frame == AnimationFrameIndex{flip});
            CHECK_FALSE(truth.shown);
            continue;
        }
        ++seen[static_cast<std::size_t>(*truth.slot)];
        const int left = places[static_cast<std::size_t>(*truth.slot)];
        CHECK(truth.gaze.place.x_px >= left);
        CHECK(truth.gaze.place.x_px < left + 400);
        CHECK(truth.shown == static_cast<std::size_t>(*truth.slot));
        if (truth.gaze.state != EyeState::blink)
            CHECK(truth.frame == AnimationFrameIndex{1000 * *truth.slot + flip});
        CHECK_FALSE(truth.target);
    }
    for (const int count : seen)
        CHECK(count > 10);
}

TEST_CASE("a closed eye is on no target, and what was shown before stays known", "[unit]") {
    SimulatedSitting sitting(3);
    for (int trial = 0; trial < 3; ++trial)
        sitting.present({trial, 0, {}});
    const SessionTime end = sitting.clock.now();
    int blinks = 0, fixations = 0, lit = 0;
    for (SessionTime at(0s); at < end; at += 5ms) {
        const GazeTruth truth = sitting.observer.truth_at(at);
        blinks += truth.gaze.state == EyeState::blink;
        fixations += truth.target.has_value();
        lit += truth.frame.has_value();
        if (truth.gaze.state != EyeState::fixation)
            CHECK_FALSE(truth.target);
        if (truth.gaze.state == EyeState::blink)
            CHECK_FALSE(truth.surface);
    }
    CHECK(blinks > 50);
    CHECK(fixations > 500);
    CHECK(lit > 500);
}

TEST_CASE("each of several shows is lit from its onset to the screen after it, whatever came since",
          "[unit]") {
    SimulatedObserver observer(pictures_at({760}), 3, test::without_wandering());
    for (int show = 0; show < 3; ++show) {
        observer.presentation_begins(trial_of_pictures(1, show), 0);
        flip_at(observer, SessionTime(10s) + 10s * show, 5 + show);
        observer.screen_shown({}, SessionTime(11s) + 10s * show);
    }
    observer.presentation_begins(trial_of_pictures(1, 3), 0); // not lit yet
    for (int show = 0; show < 3; ++show) {
        const SessionTime onset = SessionTime(10s) + 10s * show;
        CHECK_FALSE(observer.truth_at(onset - 1ms).frame);
        CHECK(observer.truth_at(onset + 20ms).frame == AnimationFrameIndex{5 + show});
        CHECK(observer.truth_at(onset + 999ms).frame == AnimationFrameIndex{5 + show});
        CHECK_FALSE(observer.truth_at(onset + 1020ms).frame);
        CHECK(observer.script_of(show));
    }
    CHECK(observer.script_of(3));
    CHECK_FALSE(observer.script_of(4));
}

TEST_CASE("to a question that nobody knows an observer says little, and to others what is asked", "[unit]") {
    ObservedScene scene = pictures_at({760});
    scene.tasks = {{"age", {0.4}}, {"anything else", {0.4}}};
    const SimulatedObserver observer(scene, 3);
    std::map<std::string, int> ages, others;
    for (int index = 0; index < 100; ++index) {
        ++ages[observer.answer_to({index, 0, {}}).text];
        ++others[observer.answer_to({index, 1, {}}).text];
    }
    CHECK(ages.size() == 4);
    CHECK(ages.contains("About twenty-five."));
    CHECK(ages.contains("In the thirties."));
    CHECK(others.size() == 4);
    for (const char* const words :
         {"I am not sure.", "I would say yes.", "It is hard to tell.", "There is little to say."})
        CHECK(others[words] > 10);
}
