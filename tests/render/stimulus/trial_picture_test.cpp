/// The picture of a trial, drawn of a surface that is no mesh.
#include "render/stimulus/trial_picture.h"

#include <catch2/catch.hpp>

using namespace overt;

namespace {

/// A disc of 100 mm in a picture of any size.
class Disc final : public SurfaceLookup {
  public:
    explicit Disc(glm::ivec2 size_px) : image_px_(size_px) {}
    std::optional<SurfacePoint> surface_at(PoseIndex, glm::dvec2 point_px) const override {
        const glm::dvec2 place = (point_px / glm::dvec2(image_px_) - 0.5) * 2.0;
        if (glm::length(place) > 0.8)
            return std::nullopt;
        SurfacePoint surface;
        surface.position = {50.0 * place.x, 0.0, -50.0 * place.y};
        return surface;
    }
    bool goes_on(PoseIndex, glm::ivec2, glm::ivec2) const override { return true; }

  private:
    glm::ivec2 image_px_;
};

LinearImage picture_of(int side_px, const std::string& caption) {
    const Disc disc({side_px, side_px});
    const std::vector<glm::dvec3> gaze(50, glm::dvec3(10.0, 0.0, 0.0));
    TrialPictureContent content;
    content.frame = LinearImage({side_px, side_px});
    content.surface = &disc;
    content.bounds = {{-50.0, -1.0, -50.0}, {50.0, 1.0, 50.0}};
    content.gaze_on_surface = gaze;
    content.kernel_sigma = 5.0;
    content.frame_caption = content.map_caption = caption;
    content.gaze_caption = "x";
    return draw_trial_picture(content);
}

} // namespace

TEST_CASE("a picture of a trial needs no mesh, gives captions the room they take, and has a scale",
          "[unit]") {
    const LinearImage brief = picture_of(256, "x");
    const LinearImage wordy =
        picture_of(256, "A caption of so many words that a panel of 256 pixels has no room "
                        "for all of them in a single line");
    CHECK(wordy.size_px.x == brief.size_px.x);
    CHECK(wordy.size_px.y > brief.size_px.y + 12);
    // Nothing of it touches the lower edge.
    for (int x = 0; x < wordy.size_px.x; ++x)
        CHECK(wordy.at(x, wordy.size_px.y - 1) == wordy.at(0, wordy.size_px.y - 1));
    // Below the last panel: dark on the left, and bright yellow on the right.
    const int left = 24 + 2 * (256 + 24), row = 24 + 256 + 12 + 6;
    CHECK(brief.at(left + 256 / 5 + 1, row).r < 0.1f);
    CHECK(brief.at(left + 256 - 256 / 5 - 2, row).r > 0.9f);
    CHECK(brief.at(left + 256 - 256 / 5 - 2, row).g > 0.8f);
    // Where gaze was, the surface is hot, and elsewhere clay.
    CHECK(brief.at(left + 128 + 25, 24 + 128).r > 2.0f * brief.at(left + 128 + 25, 24 + 128).b);
}
