#include "render/presenter/noise_picture.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/random.h"

namespace overt {

PlacedPicture draw_noise(const Screen& screen, const ScreenGeometry& geometry, int place) {
    PlacedPicture placed;
    placed.picture = LinearImage(geometry.image_px);
    placed.origin_px = geometry.image_origin_px;
    const int side_px =
        std::max(1, static_cast<int>(std::lround(screen.noise_cell.value * geometry.px_per_deg_at_centre())));
    RandomStream random(screen.noise_seed, "mask noise", static_cast<std::uint64_t>(place));
    const int columns = (geometry.image_px.x + side_px - 1) / side_px;
    std::vector<float> row(static_cast<std::size_t>(columns));
    for (int y = 0; y < geometry.image_px.y; ++y) {
        if (y % side_px == 0)
            for (float& light : row)
                light = static_cast<float>(random.uniform());
        for (int x = 0; x < geometry.image_px.x; ++x) {
            const float light = row[static_cast<std::size_t>(x / side_px)];
            placed.picture.at(x, y) = {light, light, light, 1.0f};
        }
    }
    return placed;
}

} // namespace overt
