#include "render/presenter/frame_store.h"

#include <algorithm>
#include <thread>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

int processors() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

/// Pages that are in memory twice, under way to the card: one for each processor to write, and one to hand
/// over. With more than 8, disks and the card are what is waited for.
int staged_pages() { return std::min(processors() + 1, 8); }

} // namespace

FrameStore::FrameStore(const GlContext& context, const FrameSource& source, const DisplayEncoder& encoder,
                       glm::ivec2 origin_px, glm::ivec2 image_px, std::size_t budget_bytes)
    : context_(&context), source_(&source), encoder_(&encoder), origin_px_(origin_px), image_px_(image_px),
      budget_bytes_(budget_bytes), patch_(encoder.patch_of(origin_px, image_px)) {}

FrameStore::~FrameStore() = default;

std::size_t FrameStore::page_bytes() const { return bytes_in(patch_.size_px, encoder_->format()); }

int FrameStore::pages_of(const Stimulus& stimulus) const {
    const std::vector<int> page_of_frame = source_->page_of_frame(stimulus);
    return 1 + *std::max_element(page_of_frame.begin(), page_of_frame.end());
}

bool FrameStore::fits_beside_current(int pages) const {
    const StoredStimulus& shown = stimuli_[current_];
    const int layers = pages + (shown.textures ? shown.textures->layers() : 0);
    return page_bytes() * static_cast<std::size_t>(layers) <= budget_bytes_;
}

void FrameStore::begin(const Stimulus& stimulus, int threads) {
    StoredStimulus& stored = spare();
    stored.stimulus = stimulus;
    stored.page_of_frame = source_->page_of_frame(stimulus);
    stored.pages = pages_of(stimulus);
    const std::size_t bytes = page_bytes() * static_cast<std::size_t>(stored.pages);
    if (bytes > budget_bytes_) {
        throw InputError(
            fmt::format("a stimulus takes {:.0f} MB in the frame store, which may take {:.0f}: "
                        "allow more with display.frame_store_mb, or show fewer or smaller frames",
                        1e-6 * static_cast<double>(bytes), 1e-6 * static_cast<double>(budget_bytes_)));
    }
    if (!stored.textures || stored.textures->layers() < stored.pages ||
        !fits_beside_current(stored.textures->layers())) {
        stored.textures.reset();
        stored.textures.emplace(*context_, patch_.size_px, stored.pages, encoder_->format());
    }
    if (!staging_)
        staging_.emplace(*context_, staged_pages(), page_bytes());
    expected_ = stimulus;
    loader_.emplace(
        *staging_, stored.pages,
        [this, stimulus](int page, LinearImage& room, std::span<std::byte> into) {
            const LinearImage& picture = source_->read_page(stimulus, page, room);
            OVERT_EXPECTS(picture.size_px == image_px_);
            encoder_->encode(picture, origin_px_, into);
        },
        threads);
}

void FrameStore::forget_expected() {
    loader_.reset();
    expected_.reset();
    failure_ = nullptr;
}

const StoredStimulus& FrameStore::load(const Stimulus& stimulus) {
    if (is_loaded_ && stimuli_[current_].stimulus == stimulus)
        return stimuli_[current_];
    if (failure_ && expected_ == stimulus) {
        const std::exception_ptr failure = failure_;
        forget_expected();
        std::rethrow_exception(failure);
    }
    if (expected_ != stimulus) {
        forget_expected();
        if (!fits_beside_current(pages_of(stimulus))) {
            // It takes the place of the one that was shown.
            spare().textures.reset();
            current_ = 1 - current_;
            is_loaded_ = false;
        }
        begin(stimulus, processors());
    }
    if (loader_) {
        try {
            loader_->hand_over(*spare().textures, true);
        } catch (...) {
            forget_expected();
            throw;
        }
        loader_.reset();
    }
    context_->gl().Finish();
    throw_on_gl_error(*context_, "filling the frame store");
    expected_.reset();
    current_ = 1 - current_;
    is_loaded_ = true;
    return stimuli_[current_];
}

void FrameStore::expect(const Stimulus& stimulus) noexcept {
    if ((is_loaded_ && stimuli_[current_].stimulus == stimulus) || expected_ == stimulus)
        return;
    forget_expected();
    try {
        // Somebody answers meanwhile, and time stamps are taken: one processor stays free where there are
        // more.
        if (fits_beside_current(pages_of(stimulus)))
            begin(stimulus, std::max(1, processors() - 1));
    } catch (...) {
        expected_ = stimulus;
        failure_ = std::current_exception();
    }
}

void FrameStore::use_spare_time() noexcept {
    if (!loader_ || failure_)
        return;
    try {
        loader_->hand_over(*spare().textures, false);
        if (loader_->is_done())
            loader_.reset();
    } catch (...) {
        failure_ = std::current_exception();
    }
}

} // namespace overt
