#include "app/watch/viewed_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "experiment/base/error.h"

namespace overt {

const ViewedPicture& ViewedPictures::of(const SessionFacts& facts, const SessionView& view) {
    if (view.light_file != file_) {
        file_ = view.light_file;
        light_.reset();
        picture_ = {};
        number_ = -1;
        // A view without pictures is still a view.
        if (!file_.empty()) {
            try {
                light_ = read_light_pictures(std::filesystem::path(facts.folder) / file_,
                                             {facts.image_width_px, facts.image_height_px}, view.pictures);
            } catch (const Error&) {
            }
        }
    }
    if (!light_ || view.picture < 0 || view.picture >= light_->pictures || view.picture == number_)
        return picture_;
    number_ = view.picture;
    picture_.width = light_->size().x;
    picture_.height = light_->size().y;
    picture_.lightness.resize(light_->squares());
    const std::size_t first = static_cast<std::size_t>(number_) * light_->squares();
    for (std::size_t i = 0; i < light_->squares(); ++i) {
        // As a monitor shows it, with a gamma of 2.2; what is around the object stays dark.
        const float light = light_->luminance[first + i] * light_->coverage[first + i];
        picture_.lightness[i] = std::pow(std::clamp(light, 0.0f, 1.0f), 1.0f / 2.2f);
    }
    return picture_;
}

} // namespace overt
