#include "render/gl/headless_context.h"
#include "render/presenter/frame_store.h"

#include <atomic>
#include <thread>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

namespace {

constexpr glm::ivec2 page_px{24, 16};
constexpr int pages_each = 9;
constexpr std::size_t bytes_of_page = 24 * 16 * 4;

/// Each page a grey of its own; pages of object 9 cannot be read from the third on.
class GreyPages final : public FrameSource {
  public:
    std::vector<int> page_of_frame(const Stimulus&) const override {
        std::vector<int> pages(pages_each);
        for (int i = 0; i < pages_each; ++i)
            pages[static_cast<std::size_t>(i)] = pages_each - 1 - i;
        return pages;
    }
    LinearImage page(const Stimulus& stimulus, int page) const override {
        ++read;
        if (stimulus.object == 9 && page >= 3)
            throw InputError("page 3 is damaged");
        LinearImage image(page_px);
        for (glm::vec4& pixel : image.pixels)
            pixel = glm::vec4(glm::vec3(static_cast<float>(grey_of(stimulus, page)) / 255.0f), 1.0f);
        return image;
    }
    static int grey_of(const Stimulus& stimulus, int page) { return 20 * stimulus.object + page + 1; }

    mutable std::atomic<int> read{0};
};

struct Store {
    std::unique_ptr<GlContext> context = make_headless_context(ContextKind::osmesa);
    GreyPages pages;
    DisplayEncoder encoder;
    FrameStore store;

    explicit Store(std::size_t budget_bytes = 1'000'000)
        : encoder([] {
              DisplaySettings display;
              display.width_px = 64;
              display.height_px = 64;
              display.output = OutputMode::native_8bit;
              return display;
          }()),
          store(*context, pages, encoder, {{{10, 20}, page_px}}, budget_bytes) {}

    /// The greys of all pages, as the card has them.
    std::vector<int> greys(const StoredStimuli& stimulus) const {
        std::vector<int> greys;
        Framebuffer target(*context);
        std::vector<std::byte> bytes(bytes_of_page);
        for (int page = 0; page < stimulus.pages; ++page) {
            target.attach_layer(*stimulus.textures, page);
            target.read(PixelFormat::rgba8, bytes);
            greys.push_back(std::to_integer<int>(bytes[0]));
            for (std::size_t i = 0; i < bytes_of_page; i += 4)
                REQUIRE(bytes[i] == bytes[0]);
        }
        return greys;
    }

    void let_arrive() {
        for (int i = 0; i < 20000; ++i) {
            store.use_spare_time();
            std::this_thread::sleep_for(std::chrono::microseconds(20));
            if (pages.read >= 2 * pages_each && i > 200)
                return;
        }
    }
};

std::vector<int> truth(const Stimulus& stimulus) {
    std::vector<int> greys;
    for (int page = 0; page < pages_each; ++page)
        greys.push_back(GreyPages::grey_of(stimulus, page));
    return greys;
}

} // namespace

TEST_CASE("a stimulus has its own pages on the card, whether or not it was expected", "[gl]") {
    Store bench;
    CHECK(bench.greys(bench.store.load({1, 0})) == truth({1, 0}));
    // Expected, and there in time; expected, and asked for at once; another expected than comes.
    bench.store.expect({2, 0});
    bench.let_arrive();
    CHECK(bench.greys(bench.store.load({2, 0})) == truth({2, 0}));
    bench.store.expect({3, 0});
    CHECK(bench.greys(bench.store.load({3, 0})) == truth({3, 0}));
    bench.store.expect({4, 0});
    bench.store.use_spare_time();
    CHECK(bench.greys(bench.store.load({5, 0})) == truth({5, 0}));
    CHECK(bench.store.load({5, 0}).page_of(0, 0) == pages_each - 1);
}

TEST_CASE("the stimuli of a trial lie one after another, each once", "[gl]") {
    Store bench;
    const std::vector<PlacedStimulus> two{{{1, 0}, 0}, {{3, 0}, 0}, {{1, 0}, 0}};
    std::vector<int> all = truth({1, 0});
    const std::vector<int> second = truth({3, 0});
    all.insert(all.end(), second.begin(), second.end());
    const StoredStimuli& stored = bench.store.load(two);
    CHECK(bench.greys(stored) == all);
    CHECK(stored.page_of(0, 0) == pages_each - 1);
    CHECK(stored.page_of(1, 0) == 2 * pages_each - 1);
    CHECK(stored.page_of(1, pages_each - 1) == pages_each);
    // They are there already; one of them alone is another trial's.
    const int read = bench.pages.read;
    bench.store.load(two);
    CHECK(bench.pages.read == read);
    CHECK(bench.greys(bench.store.load({3, 0})) == second);
}

TEST_CASE("the shown stimulus stays whole while the next arrives", "[gl]") {
    Store bench;
    const StoredStimuli& shown = bench.store.load({1, 0});
    bench.store.expect({2, 0});
    bench.store.use_spare_time();
    CHECK(bench.greys(shown) == truth({1, 0}));
    bench.let_arrive();
    CHECK(bench.greys(shown) == truth({1, 0}));
}

TEST_CASE("what was expected and has arrived is not read again", "[gl]") {
    Store bench;
    bench.store.load({1, 0});
    bench.store.expect({2, 0});
    bench.let_arrive();
    REQUIRE(bench.pages.read == 2 * pages_each);
    bench.store.load({2, 0});
    bench.store.load({2, 0});
    bench.store.expect({2, 0});
    bench.store.use_spare_time();
    CHECK(bench.pages.read == 2 * pages_each);
}

TEST_CASE("a stimulus that cannot be read fails when it is loaded, and the next one does not", "[gl]") {
    Store bench;
    bench.store.load({1, 0});
    CHECK_THROWS_AS(bench.store.load({9, 0}), InputError);
    bench.store.expect({9, 0});
    for (int i = 0; i < 200; ++i) {
        bench.store.use_spare_time();
        std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    CHECK_THROWS_AS(bench.store.load({9, 0}), InputError);
    CHECK(bench.greys(bench.store.load({2, 0})) == truth({2, 0}));
}

TEST_CASE("a frame store too small for two stimuli holds one, and refuses what is larger than itself",
          "[gl]") {
    Store one(bytes_of_page * (pages_each + 3));
    one.store.load({1, 0});
    one.store.expect({2, 0});
    // Pages would be read in the background.
    for (int i = 0; i < 200; ++i) {
        one.store.use_spare_time();
        std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    CHECK(one.pages.read == pages_each);
    CHECK(one.greys(one.store.load({2, 0})) == truth({2, 0}));
    CHECK(one.greys(one.store.load({3, 0})) == truth({3, 0}));
    // What is shown together does not come from disk.
    const std::vector<PlacedStimulus> two{{{1, 0}, 0}, {{3, 0}, 0}};
    CHECK_THROWS_AS(one.store.load(two), InputError);
    CHECK(one.greys(one.store.load({2, 0})) == truth({2, 0}));
    Store none(bytes_of_page * (least_streamed_pages - 1));
    CHECK_THROWS_AS(none.store.load({1, 0}), InputError);
}
