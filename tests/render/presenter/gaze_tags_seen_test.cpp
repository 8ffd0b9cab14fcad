/// AprilTags on the screen, as the maker's detector sees them.
#include <array>
#include <map>

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <catch2/catch.hpp>

#include "tests/render/presenter/presenter_bench.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr glm::ivec2 wide_px{640, 480};

/// The outer corners of the black border of each tag that is found, by its id: top left and bottom right.
using FoundTags = std::map<int, std::array<glm::dvec2, 2>>;

FoundTags detect(const std::vector<std::byte>& canvas, const auto& grey_at) {
    image_u8_t* const image = image_u8_create(wide_px.x, wide_px.y);
    for (int y = 0; y < wide_px.y; ++y)
        for (int x = 0; x < wide_px.x; ++x)
            image->buf[y * image->stride + x] = grey_at(canvas, x, y);
    apriltag_family_t* const family = tag36h11_create();
    apriltag_detector_t* const detector = apriltag_detector_create();
    apriltag_detector_add_family(detector, family);
    detector->quad_decimate = 1.0F;
    zarray_t* const detections = apriltag_detector_detect(detector, image);
    FoundTags found;
    for (int i = 0; i < zarray_size(detections); ++i) {
        apriltag_detection_t* detection = nullptr;
        zarray_get(detections, i, &detection);
        CHECK(detection->hamming == 0);
        // Counter-clockwise from the bottom left of an upright tag.
        found[detection->id] = {glm::dvec2(detection->p[3][0], detection->p[3][1]),
                                glm::dvec2(detection->p[1][0], detection->p[1][1])};
    }
    apriltag_detections_destroy(detections);
    apriltag_detector_destroy(detector);
    tag36h11_destroy(family);
    image_u8_destroy(image);
    return found;
}

std::uint8_t red(const std::vector<std::byte>& canvas, int x, int y) {
    return std::to_integer<std::uint8_t>(canvas[static_cast<std::size_t>(y * wide_px.x + x) * 4]);
}

struct WideBench : Bench {
    explicit WideBench(int tags_px) {
        geometry.screen_px = wide_px;
        geometry.image_origin_px = centred_origin_px(wide_px, image_px);
        settings.tags_px = tags_px;
        screens.text_height_deg = 0.2;
    }
};

void check_places(const FoundTags& found, const std::vector<TagPlace>& tags) {
    REQUIRE(found.size() == tags.size());
    for (const TagPlace& tag : tags) {
        CAPTURE(tag.id);
        REQUIRE(found.contains(tag.id));
        const glm::dvec2 border = 0.1 * glm::dvec2(tag.size_px);
        CHECK(glm::distance(found.at(tag.id)[0], glm::dvec2(tag.origin_px) + border) < 1.0);
        CHECK(glm::distance(found.at(tag.id)[1], glm::dvec2(tag.end_px()) - border) < 1.0);
    }
}

} // namespace

TEST_CASE("the detector of AprilTag finds all tags at their places, on frames and on screens", "[gl]") {
    WideBench bench(60);
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    const std::vector<TagPlace> tags = gaze_tags_of(bench.geometry, bench.settings);
    REQUIRE(tags.size() == 6);
    presenter.load_frames({0, 0});
    presenter.flip({2});
    check_places(detect(presenter.read_canvas(), red), tags);
    presenter.show({Screen::Kind::target, ""});
    check_places(detect(presenter.read_canvas(), red), tags);
    presenter.show({});
    check_places(detect(presenter.read_canvas(), red), tags);
}

TEST_CASE("tags leave every pixel of the stimulus as it is", "[gl]") {
    WideBench without(0), with(60);
    const auto page_of = [](WideBench& bench) {
        PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                                bench.screens);
        presenter.load_frames({1, 0});
        presenter.flip({1});
        return presenter.read_canvas();
    };
    const std::vector<std::byte> bare = page_of(without), tagged = page_of(with);
    const glm::ivec2 first = with.geometry.image_origin_px - tag_distance_px,
                     end = with.geometry.image_origin_px + image_px + tag_distance_px;
    int differing = 0, elsewhere = 0;
    for (int y = 0; y < wide_px.y; ++y) {
        for (int x = 0; x < wide_px.x; ++x) {
            const bool differs = red(bare, x, y) != red(tagged, x, y);
            (x >= first.x && x < end.x && y >= first.y && y < end.y ? differing : elsewhere) += differs;
        }
    }
    CHECK(differing == 0);
    CHECK(elsewhere > 6 * 60 * 60 / 2);
}

TEST_CASE("the codes of tags are those of the family", "[unit]") {
    apriltag_family_t* const family = tag36h11_create();
    for (int id = 0; id < most_tags; ++id) {
        image_u8_t* const image = apriltag_to_image(family, static_cast<std::uint32_t>(id));
        REQUIRE((image->width == tag_modules && image->height == tag_modules));
        int differing = 0;
        for (int y = 0; y < tag_modules; ++y)
            for (int x = 0; x < tag_modules; ++x)
                differing += (image->buf[y * image->stride + x] > 127) != is_white_module(id, x, y);
        CHECK(differing == 0);
        image_u8_destroy(image);
    }
    tag36h11_destroy(family);
}
