#include "app/rig/output_verification.h"

#include <algorithm>
#include <atomic>
#include <set>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "render/gl/headless_context.h"

using namespace overt;

namespace {

/// Keeps the events of a session.
class EventList final : public SessionLog {
  public:
    std::vector<std::string> kinds, details;
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent& event) override {
        kinds.emplace_back(event.kind);
        details.push_back(event.detail);
    }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
};

/// Three random pages for each stimulus; the last may change from one reading to the next.
class Pages final : public FrameSource {
  public:
    Pages(glm::ivec2 size, bool changes) : size_(size), changes_(changes) {}
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0, 1, 2, 1, 0}; }
    LinearImage page(const Stimulus& stimulus, int page) const override {
        LinearImage image(size_);
        RandomStream random(static_cast<std::uint64_t>(stimulus.material), "page",
                            static_cast<std::uint64_t>(page));
        for (glm::vec4& pixel : image.pixels)
            pixel = glm::vec4(glm::vec3(static_cast<float>(random.uniform())), 1.0f);
        if (page == 2 && changes_ && reads_++ > 0)
            image.at(7, 5) = glm::vec4(1.0f);
        return image;
    }

  private:
    glm::ivec2 size_;
    bool changes_;
    mutable std::atomic<int> reads_{0};
};

/// A session of four trials with two stimuli.
struct Plan {
    Protocol protocol;
    Schedule schedule;
    Plan() {
        protocol.display.width_px = 640;
        protocol.display.height_px = 200;
        protocol.views.front().width_px = 33;
        protocol.views.front().height_px = 21;
        protocol.views.front().left_px = 55;
        protocol.tasks.resize(1);
        protocol.objects.resize(1);
        protocol.objects[0].id = "muse";
        protocol.materials.resize(2);
        protocol.materials[0].id = "gold";
        protocol.materials[1].id = "clay";
        for (const int material : {1, 0, 0, 1}) {
            Trial trial;
            trial.stimulus = {0, material};
            schedule.trials.push_back(trial);
        }
    }
};

/// Verifies a plan's stimuli and gives the events.
EventList verified(const Plan& plan, const Pages& pages) {
    EventList events;
    const auto context = make_headless_context(ContextKind::osmesa);
    VirtualClock clock;
    VirtualDisplay display(*context, clock, 120.0);
    PagePresenter presenter(*context, display, pages, screen_geometry_of(plan.protocol),
                            plan.protocol.display, plan.protocol.screens);
    try {
        PagePresenter* const presenters[] = {&presenter};
        record_verification(presenters, pages, plan.protocol, plan.schedule, clock, events, {});
    } catch (const GraphicsError& error) {
        events.kinds.emplace_back("refused");
        events.details.emplace_back(error.what());
    }
    return events;
}

} // namespace

TEST_CASE("every page of a session is verified once, with the hash of what is sent", "[gl]") {
    const Plan plan;
    const Pages pages({33, 21}, false);
    const EventList events = verified(plan, pages);
    REQUIRE(events.details.size() == 6);
    std::set<std::string> hashes;
    for (std::size_t i = 0; i < 6; ++i) {
        CAPTURE(events.details[i]);
        CHECK(events.kinds[i] == "output verified");
        // 640 / 2 pairs of three channels in all rows but the first three.
        const std::string begin = std::string(i < 3 ? "muse/clay" : "muse/gold") + " page " +
                                  std::to_string(i % 3) + ": 0 of 189120 values differ";
        CHECK(events.details[i].rfind(begin, 0) == 0);
        hashes.insert(events.details[i].substr(events.details[i].size() - 64));
    }
    CHECK(hashes.size() == 6);
    // The same bytes in another session.
    CHECK(verified(plan, pages).details == events.details);
}

TEST_CASE("a page that is sent otherwise than it is stops the session, with the difference on record",
          "[gl]") {
    const Plan plan;
    const Pages pages({33, 21}, true);
    const EventList events = verified(plan, pages);
    REQUIRE(events.details.size() == 7);
    CHECK(events.kinds.back() == "refused");
    CHECK(events.details[2].rfind("muse/clay page 2: 3 of 189120 values differ", 0) == 0);
    CHECK(events.details.back().find("muse/clay page 2") != std::string::npos);
}

TEST_CASE("light beyond black and white is counted by channel, among the object's pixels", "[unit]") {
    LinearImage picture({10, 1});
    for (int x = 0; x < 8; ++x)
        picture.at(x, 0) = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    picture.at(0, 0).r = 1.0f; // white itself is no more than white
    picture.at(1, 0).r = 1.01f;
    picture.at(2, 0).r = 7.0f;
    picture.at(3, 0).g = -1e-6f;
    picture.at(4, 0) = {0.0f, 0.0f, 0.9f, 0.5f}; // half transparent: the background adds to it
    picture.at(9, 0) = {5.0f, 5.0f, 5.0f, 0.0f}; // beside the object
    const ClippedPixels clipped = count_clipped(picture, 0.4);
    CHECK(clipped.object_pixels == 8);
    CHECK(clipped.above == std::array<std::int64_t, 3>{2, 0, 1});
    CHECK(clipped.below == std::array<std::int64_t, 3>{0, 1, 0});
    CHECK(clipped.share_above(0) == 0.25);
    CHECK(clipped.any());
    CHECK_FALSE(count_clipped(LinearImage({4, 4}), 0.0).any());
    CHECK(count_clipped(LinearImage({4, 4}), 0.0).share_above(0) == 0.0);
}
