#include "app/watch/viewed_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "experiment/base/error.h"

namespace overt {

const ViewedPicture& ViewedPictures::of(const SessionFacts& facts, const ViewedSlot& slot,
                                        const ViewedStimulus& shown) {
    if (shown.light_file != file_) {
        file_ = shown.light_file;
        light_.reset();
        picture_ = {};
        number_ = -1;
        // A view without pictures is still a view.
        if (!file_.empty()) {
            try {
                light_ = read_light_pictures(std::filesystem::path(facts.folder) / file_,
                                             {slot.width_px, slot.height_px}, shown.pictures);
            } catch (const Error&) {
            }
        }
    }
    if (!light_ || shown.picture < 0 || shown.picture >= light_->pictures || shown.picture == number_)
        return picture_;
    number_ = shown.picture;
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
