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

int FrameStore::pages_of(std::span<const Stimulus> stimuli) const {
    int pages = 0;
    for (const Stimulus& stimulus : stimuli)
        pages += 1 + std::ranges::max(source_->page_of_frame(stimulus));
    return pages;
}

bool FrameStore::fits_beside_current(int pages) const {
    const StoredStimuli& shown = stored_[current_];
    const int layers = pages + (shown.textures ? shown.textures->layers() : 0);
    return page_bytes() * static_cast<std::size_t>(layers) <= budget_bytes_;
}

bool FrameStore::is_current(std::span<const Stimulus> stimuli) const noexcept {
    return is_loaded_ && std::ranges::equal(stored_[current_].stimuli, stimuli);
}

bool FrameStore::is_expected(std::span<const Stimulus> stimuli) const noexcept {
    return expected_ && std::ranges::equal(*expected_, stimuli);
}

void FrameStore::begin(std::span<const Stimulus> stimuli, int threads) {
    StoredStimuli& stored = spare();
    stored.stimuli.assign(stimuli.begin(), stimuli.end());
    stored.page_of_frame.clear();
    stored.first_page.clear();
    stored.pages = 0;
    for (const Stimulus& stimulus : stimuli) {
        std::vector<int>& page_of_frame = stored.page_of_frame.emplace_back(source_->page_of_frame(stimulus));
        const int pages = 1 + std::ranges::max(page_of_frame);
        for (int& page : page_of_frame)
            page += stored.pages;
        stored.first_page.push_back(stored.pages);
        stored.pages += pages;
    }
    const std::size_t bytes = page_bytes() * static_cast<std::size_t>(stored.pages);
    if (bytes > budget_bytes_) {
        throw InputError(
            fmt::format("{} {:.0f} MB in the frame store, which may take {:.0f}: "
                        "allow more with display.frame_store_mb, or show fewer or smaller frames",
                        stimuli.size() == 1 ? "a stimulus takes" : "the stimuli of a trial take",
                        1e-6 * static_cast<double>(bytes), 1e-6 * static_cast<double>(budget_bytes_)));
    }
    if (!stored.textures || stored.textures->layers() < stored.pages ||
        !fits_beside_current(stored.textures->layers())) {
        stored.textures.reset();
        stored.textures.emplace(*context_, patch_.size_px, stored.pages, encoder_->format());
    }
    if (!staging_)
        staging_.emplace(*context_, staged_pages(), page_bytes());
    expected_ = stored.stimuli;
    loader_.emplace(
        *staging_, stored.pages,
        [this, of = stored.stimuli, first_page = stored.first_page](int page, LinearImage& room,
                                                                    std::span<std::byte> into) {
            const auto after = std::ranges::upper_bound(first_page, page) - first_page.begin();
            const auto index = static_cast<std::size_t>(after - 1);
            const LinearImage& picture = source_->read_page(of[index], page - first_page[index], room);
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

const StoredStimuli& FrameStore::load(std::span<const Stimulus> stimuli) {
    if (is_current(stimuli))
        return stored_[current_];
    if (failure_ && is_expected(stimuli)) {
        const std::exception_ptr failure = failure_;
        forget_expected();
        std::rethrow_exception(failure);
    }
    if (!is_expected(stimuli)) {
        forget_expected();
        if (!fits_beside_current(pages_of(stimuli))) {
            // They take the place of those that were shown.
            spare().textures.reset();
            current_ = 1 - current_;
            is_loaded_ = false;
        }
        begin(stimuli, processors());
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
    return stored_[current_];
}

void FrameStore::expect(std::span<const Stimulus> stimuli) noexcept {
    if (is_current(stimuli) || is_expected(stimuli))
        return;
    forget_expected();
    try {
        // Somebody answers meanwhile, and time stamps are taken: one processor stays free where there are
        // more.
        if (fits_beside_current(pages_of(stimuli)))
            begin(stimuli, std::max(1, processors() - 1));
    } catch (...) {
        failure_ = std::current_exception();
        expected_.emplace(stimuli.begin(), stimuli.end());
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
