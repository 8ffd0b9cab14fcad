/// Pages for benchmarks that show something.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "experiment/base/random.h"
#include "render/presenter/page_presenter.h"

namespace overt {

/// 61 pages of random light, in memory: the picture of each is another than that of the pages before it.
class RandomPages final : public FrameSource {
  public:
    static constexpr int count = 61;

    explicit RandomPages(int size_px) {
        for (std::uint64_t i = 0; i < 4; ++i) {
            RandomStream random(1, "pages", i);
            pictures_.emplace_back(glm::ivec2(size_px));
            for (glm::vec4& pixel : pictures_.back().pixels) {
                pixel = {static_cast<float>(random.uniform()), static_cast<float>(random.uniform()),
                         static_cast<float>(random.uniform()), 1.0f};
            }
        }
    }
    std::vector<int> page_of_frame(const Stimulus&) const override {
        std::vector<int> pages(count);
        std::iota(pages.begin(), pages.end(), 0);
        return pages;
    }
    LinearImage page(const Stimulus&, int page) const override { return picture(page); }
    const LinearImage& read_page(const Stimulus&, int page, LinearImage&) const override {
        return picture(page);
    }

  private:
    const LinearImage& picture(int page) const {
        return pictures_[static_cast<std::size_t>(page) % pictures_.size()];
    }

    std::vector<LinearImage> pictures_;
};

} // namespace overt
