/// The live map of the operator's view: what gaze meets, and where it adds up.
#include <catch2/catch.hpp>

#include <thread>

#include "app/record/recorded_surface.h"
#include "app/watch/live_saliency.h"
#include "experiment/base/error.h"
#include "tests/app/session/interrupted_run.h"

using namespace overt;
using namespace overt::test;

namespace {

std::shared_ptr<const SaliencyMap> awaited(const LiveSaliency& saliency, const std::string& object,
                                           const std::function<bool(const SaliencyMap&)>& is_it,
                                           const std::string& slot = {}) {
    for (int tries = 0; tries < 3000; ++tries) {
        auto map = saliency.newest(object, slot);
        if (map && is_it(*map))
            return map;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return nullptr;
}

} // namespace

TEST_CASE("a view meets the surface where the session's own maps have it, and adds gaze up there",
          "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run().exit_code == 0);
    const std::filesystem::path folder = experiment.session(1);
    const SessionRecord record(folder);
    RecordedSurfaces surfaces(record);
    const ScreenGeometry& screen = record.header().display.screen;
    const auto object = std::make_shared<const WatchedObject>(folder, "bust");
    const SurfaceLookup* const maps = surfaces.lookup_of({0});
    REQUIRE(maps);
    int met = 0, missed = 0;
    std::optional<RayHit> first, last;
    for (const int pose : {0, 7, 14})
        for (double y = -3.3; y < screen.image_px.y + 3.0; y += 4.7)
            for (double x = -3.3; x < screen.image_px.x + 3.0; x += 4.7) {
                const auto expected = maps->surface_at(PoseIndex{pose}, {x, y});
                const auto hit = object->met_at(screen.screen_from_image({x, y}), pose);
                REQUIRE(hit.has_value() == expected.has_value());
                ++(hit ? met : missed);
                if (!hit)
                    continue;
                CHECK(glm::distance(hit->position, expected->position) < 1e-6);
                CHECK(object->part_of(*hit) == object->mesh().part_names[expected->part]);
                if (!first)
                    first = hit;
                last = hit;
            }
    REQUIRE(met > 100);
    CHECK(missed > 100);
    CHECK(!object->met_at(screen.centre(), -1));
    CHECK(!object->met_at(screen.centre(), 15));
    CHECK_THROWS_AS(WatchedObject(folder, "nobody"), InputError);

    LiveSaliency saliency;
    saliency.prepare(object);
    const auto empty = awaited(saliency, "bust", [](const SaliencyMap&) { return true; });
    REQUIRE(empty);
    CHECK(empty->gaze_s == 0.0);
    CHECK(*std::ranges::max_element(empty->share) == 0.0f);
    saliency.looked(object, "", 0, *first, 3.0);
    saliency.looked(object, "", 1, *last, 1.0);
    // What was seen of it in another slot is in that slot's map.
    saliency.looked(object, "right", 1, *last, 8.0);
    const auto both =
        awaited(saliency, "bust", [](const SaliencyMap& map) { return map.gaze_s == Approx(4.0); });
    REQUIRE(both);
    REQUIRE(both->share.size() == both->surface->positions.size());
    CHECK(awaited(
        saliency, "bust", [](const SaliencyMap& map) { return map.gaze_s == Approx(8.0); }, "right"));
    const auto highest = [](const SaliencyMap& map) {
        return glm::dvec3(map.surface->positions[static_cast<std::size_t>(
            std::ranges::max_element(map.share) - map.share.begin())]);
    };
    const double kernel = object->degree_on_surface();
    REQUIRE(glm::distance(first->position, last->position) > 3.0 * kernel);
    CHECK(glm::distance(highest(*both), first->position) < 1.5 * kernel);
    CHECK(*std::ranges::max_element(both->share) == 1.0f);
    CHECK(*std::ranges::min_element(both->share) >= 0.0f);
    // Each area's share of it; of a hit on each of two parts, the times that were given.
    const auto share_of = [&](const SaliencyMap& map, const RayHit& hit) {
        const auto found = std::ranges::find(map.areas, object->part_of(hit), &AreaTally::Share::area);
        REQUIRE(found != map.areas.end());
        return found->share;
    };
    REQUIRE(object->part_of(*first) != object->part_of(*last));
    CHECK(share_of(*both, *first) == Approx(0.75));
    CHECK(share_of(*both, *last) == Approx(0.25));
    // Of the last trial alone.
    saliency.show(LiveSaliency::Of::trial);
    const auto of_trial =
        awaited(saliency, "bust", [](const SaliencyMap& map) { return map.gaze_s == Approx(1.0); });
    REQUIRE(of_trial);
    CHECK(glm::distance(highest(*of_trial), last->position) < 1.5 * kernel);
    CHECK(share_of(*of_trial, *last) == Approx(1.0));
    CHECK(share_of(*of_trial, *first) == 0.0);
}
