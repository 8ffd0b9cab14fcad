/// Stimuli of more pages than the frame store has room for: they come while they are shown.
#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "render/presenter/frame_store.h"
#include "tests/render/presenter/presenter_bench.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr int long_pages = 40, room = 10;
constexpr std::size_t page_bytes_each = std::size_t{32} * 32 * 4;

/// 40 pages there and 38 back again, each a grey of its own; of object 9 the one with number 30 cannot be
/// read, of object 8 each takes some time.
class LongPages final : public FrameSource {
  public:
    std::vector<int> page_of_frame(const Stimulus&) const override {
        std::vector<int> pages(long_pages);
        std::iota(pages.begin(), pages.end(), 0);
        for (int page = long_pages - 2; page > 0; --page)
            pages.push_back(page);
        return pages;
    }
    LinearImage page(const Stimulus& stimulus, int page) const override {
        ++read;
        if (stimulus.object == 9 && page == 30)
            throw InputError("page 30 is damaged");
        if (stimulus.object == 8)
            std::this_thread::sleep_for(std::chrono::milliseconds(1 + page % 3));
        LinearImage image(image_px);
        for (glm::vec4& pixel : image.pixels)
            pixel = glm::vec4(glm::vec3(static_cast<float>(grey_of(stimulus, page)) / 255.0f), 1.0f);
        return image;
    }
    static int grey_of(const Stimulus& stimulus, int page) { return 10 * stimulus.object + page + 1; }

    mutable std::atomic<int> read{0};
};

struct StreamBench : Bench {
    LongPages long_ones;
    DisplayEncoder encoder{[this] {
        DisplaySettings of_screen = settings;
        of_screen.width_px = screen_px.x;
        of_screen.height_px = screen_px.y;
        return of_screen;
    }()};
    FrameStore store{*context, long_ones, encoder, {geometry.image_box()}, page_bytes_each* room};

    /// What the card has where a page is said to be.
    int grey_at(int page) {
        const StoredStimuli& stored = *loaded;
        Framebuffer target(*context);
        std::vector<std::byte> bytes(page_bytes_each);
        target.attach_layer(*stored.textures, store.layer_of(page));
        target.read(PixelFormat::rgba8, bytes);
        return std::to_integer<int>(bytes[0]);
    }
    void load(const Stimulus& stimulus) { loaded = &store.load(stimulus); }
    const StoredStimuli* loaded = nullptr;
};

} // namespace

TEST_CASE("pages that do not all fit are there when their frames' turn comes, round after round", "[gl]") {
    for (const int object : {1, 8}) {
        StreamBench bench;
        const Stimulus stimulus{object, 0};
        bench.load(stimulus);
        CHECK(bench.loaded->pages == long_pages);
        CHECK(bench.loaded->textures->layers() == room);
        const std::vector<int> page_of = bench.long_ones.page_of_frame(stimulus);
        for (std::size_t shown = 0; shown < 3 * page_of.size(); ++shown) {
            const int page = bench.loaded->page_of(0, static_cast<int>(shown % page_of.size()));
            CAPTURE(object, shown, page);
            REQUIRE(bench.grey_at(page) == LongPages::grey_of(stimulus, page));
            bench.store.stream_on();
            // Held for another refresh.
            REQUIRE(bench.grey_at(page) == LongPages::grey_of(stimulus, page));
        }
    }
}

TEST_CASE("frames that are left out or asked for in another order have their own pages, too", "[gl]") {
    StreamBench bench;
    const Stimulus stimulus{1, 0};
    bench.load(stimulus);
    RandomStream random(3, "frames");
    int frame = 0;
    for (int shown = 0; shown < 150; ++shown) {
        frame += static_cast<int>(random.below(4)); // late, as far as what is kept reaches
        const int page = bench.loaded->page_of(0, frame % (2 * long_pages - 2));
        CAPTURE(shown, frame, page);
        REQUIRE(bench.grey_at(page) == LongPages::grey_of(stimulus, page));
        if (shown % 3 == 0)
            bench.store.stream_on();
    }
    for (const int page : {39, 0, 20, 19, 5, 39, 38}) {
        // What lies between is not read: what is kept, and what is under way, alone.
        const int before = bench.long_ones.read;
        REQUIRE(bench.grey_at(page) == LongPages::grey_of(stimulus, page));
        CHECK(bench.long_ones.read <= before + 2 * room + 9);
    }
    // From the begin: at once what is shown first.
    bench.store.rewind();
    const int read = bench.long_ones.read;
    for (int page = 0; page < 3; ++page)
        CHECK(bench.grey_at(page) == LongPages::grey_of(stimulus, page));
    CHECK(bench.long_ones.read <= read + room); // read once, and on
    bench.load(stimulus);
    CHECK(bench.grey_at(0) == LongPages::grey_of(stimulus, 0));
}

TEST_CASE("a page that comes when its turn is over does not take the place of the next in its layer",
          "[gl]") {
    StreamBench bench;
    PageStaging staging(*bench.context, 4, page_bytes_each);
    TextureArray layers(*bench.context, image_px, 2, PixelFormat::rgba8);
    std::atomic<bool> may_end{false};
    const auto fill = [&](int page, LinearImage&, std::span<std::byte> into) {
        while (page == 1 && !may_end)
            std::this_thread::sleep_for(std::chrono::microseconds(50));
        std::ranges::fill(into, static_cast<std::byte>(10 + page));
        return image_px;
    };
    PageLoader loader(staging, {{0, 1, 2, 3, 4, 5, 6, 7}, 2, true}, fill, 2);
    const auto hand_over_until_has = [&](std::int64_t turn) {
        while (!loader.has(turn))
            REQUIRE(loader.hand_over_one(layers, PageLoader::Wait::yes));
    };
    hand_over_until_has(0);
    loader.let_go_before(2); // the second frame was left out, while its page was being read
    hand_over_until_has(2);
    hand_over_until_has(3); // in the layer that was the second's
    may_end = true;
    REQUIRE(loader.hand_over_one(layers, PageLoader::Wait::yes));
    CHECK(loader.is_full());
    CHECK(loader.has(3));
    Framebuffer target(*bench.context);
    std::vector<std::byte> bytes(page_bytes_each);
    target.attach_layer(layers, 1);
    target.read(PixelFormat::rgba8, bytes);
    CHECK(std::to_integer<int>(bytes[0]) == 13);
}

TEST_CASE("a stimulus that fits takes the place of one that does not, and the other way round", "[gl]") {
    StreamBench bench;
    bench.load({1, 0});
    bench.store.expect({2, 0}); // has no room beside it: nothing is read
    bench.store.use_spare_time();
    bench.load({2, 0});
    CHECK(bench.grey_at(7) == LongPages::grey_of({2, 0}, 7));
    CHECK(bench.grey_at(25) == LongPages::grey_of({2, 0}, 25));
    bench.load({1, 0});
    CHECK(bench.grey_at(0) == LongPages::grey_of({1, 0}, 0));
}

TEST_CASE("a page that cannot be read fails where it is shown, and neither before nor elsewhere", "[gl]") {
    StreamBench bench;
    bench.load({9, 0});
    // Those before it that were on their way are shown.
    for (int page = 0; page <= 30 - room; ++page) {
        REQUIRE(bench.grey_at(page) == LongPages::grey_of({9, 0}, page));
        CHECK_NOTHROW(bench.store.stream_on());
    }
    const auto show_on = [&] {
        for (int page = 31 - room; page <= 30; ++page)
            bench.grey_at(page);
    };
    CHECK_THROWS_WITH(show_on(), "page 30 is damaged");
    CHECK_NOTHROW(bench.store.stream_on());
    bench.load({1, 0});
    CHECK(bench.grey_at(3) == LongPages::grey_of({1, 0}, 3));
}

TEST_CASE("a presenter shows each page of what streams, and closes where one cannot be read", "[gl]") {
    StreamBench bench;
    bench.settings.frame_store_mb = 1e-6 * static_cast<double>(page_bytes_each * room + 1);
    PagePresenter presenter(*bench.context, bench.display, bench.long_ones, bench.geometry, bench.settings,
                            bench.screens);
    const Stimulus sound{1, 0};
    presenter.load_frames(sound);
    const std::vector<int> page_of = bench.long_ones.page_of_frame(sound);
    const glm::ivec2 middle = bench.geometry.image_origin_px + image_px / 2;
    for (int turn = 0; turn < 2; ++turn) {
        for (std::size_t frame = 0; frame < page_of.size(); ++frame) {
            presenter.flip({static_cast<int>(frame)});
            REQUIRE(red_at(presenter.read_canvas(), middle) == LongPages::grey_of(sound, page_of[frame]));
        }
        // The next attempt begins anew, in the middle of the round.
        presenter.flip({5});
        presenter.load_frames(sound);
    }
    CHECK_FALSE(presenter.closed());
    CHECK(red_at(presenter.read_page(33), middle) == LongPages::grey_of(sound, 33));
    presenter.load_frames({9, 0});
    for (int frame = 0; frame < long_pages && !presenter.closed(); ++frame)
        presenter.flip({frame});
    CHECK(presenter.closed());
    CHECK(presenter.why_closed() == "a frame could not be shown: page 30 is damaged");
}
