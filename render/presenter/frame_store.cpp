#include "render/presenter/frame_store.h"

#include <algorithm>
#include <numeric>
#include <thread>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

int processors() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

/// Pages that are in memory twice, under way to the card: one for each processor to write, and one to hand
/// over. With more than 8, disks and the card are what is waited for.
int staged_pages() { return std::min(processors() + 1, 8); }

/// While somebody answers or looks, and time stamps are taken, one processor stays free where there are more.
int threads_beside_a_session() { return std::max(1, processors() - 1); }

} // namespace

FrameStore::FrameStore(const GlContext& context, const FrameSource& source, const DisplayEncoder& encoder,
                       std::vector<ImageBox> slots, std::size_t budget_bytes, Eye eye)
    : context_(&context), source_(&source), eye_(eye), encoder_(&encoder), slots_(std::move(slots)),
      budget_bytes_(budget_bytes) {
    OVERT_EXPECTS(!slots_.empty());
    for (const ImageBox& slot : slots_) {
        patches_.push_back(encoder.patch_of(slot.origin_px, slot.size_px));
        layer_px_ = glm::max(layer_px_, patches_.back().size_px);
    }
}

FrameStore::~FrameStore() = default;

bool FrameStore::is_same(const SlotPicture& a, const SlotPicture& b) const noexcept {
    return a.stimulus == b.stimulus && slots_[static_cast<std::size_t>(a.slot)].size_px ==
                                           slots_[static_cast<std::size_t>(b.slot)].size_px;
}

bool FrameStore::are_same(std::span<const SlotPicture> a, std::span<const SlotPicture> b) const noexcept {
    return std::ranges::equal(
        a, b, [this](const SlotPicture& one, const SlotPicture& other) { return is_same(one, other); });
}

std::vector<SlotPicture> FrameStore::pictures_of(std::span<const PlacedStimulus> shown) const {
    std::vector<SlotPicture> pictures;
    for (const PlacedStimulus& placed : shown) {
        OVERT_EXPECTS(placed.slot >= 0 && static_cast<std::size_t>(placed.slot) < slots_.size());
        const SlotPicture picture{source_->in_slot(placed, eye_), placed.slot};
        if (std::ranges::none_of(pictures, [&](const SlotPicture& had) { return is_same(had, picture); }))
            pictures.push_back(picture);
    }
    return pictures;
}

std::size_t FrameStore::picture_of(const StoredStimuli& stored, const PlacedStimulus& placed) const {
    const SlotPicture wanted{source_->in_slot(placed, eye_), placed.slot};
    const auto found =
        std::ranges::find_if(stored.pictures, [&](const SlotPicture& had) { return is_same(had, wanted); });
    OVERT_EXPECTS(found != stored.pictures.end());
    return static_cast<std::size_t>(found - stored.pictures.begin());
}

std::size_t FrameStore::page_bytes() const { return bytes_in(layer_px_, encoder_->format()); }

int FrameStore::pages_of(std::span<const SlotPicture> pictures) const {
    int pages = 0;
    for (const SlotPicture& picture : pictures)
        pages += 1 + std::ranges::max(source_->page_of_frame(picture.stimulus));
    return pages;
}

bool FrameStore::fits_beside_current(int pages) const {
    const StoredStimuli& shown = stored_[current_];
    const int layers = pages + (shown.textures ? shown.textures->layers() : 0);
    return page_bytes() * static_cast<std::size_t>(layers) <= budget_bytes_;
}

bool FrameStore::is_current(std::span<const SlotPicture> pictures) const noexcept {
    return is_loaded_ && are_same(stored_[current_].pictures, pictures);
}

bool FrameStore::is_expected(std::span<const SlotPicture> pictures) const noexcept {
    return expected_ && are_same(*expected_, pictures);
}

void FrameStore::begin(std::span<const SlotPicture> pictures, int threads) {
    StoredStimuli& stored = spare();
    stored.pictures.assign(pictures.begin(), pictures.end());
    stored.page_of_frame.clear();
    stored.first_page.clear();
    stored.pages = 0;
    for (const SlotPicture& picture : pictures) {
        std::vector<int>& page_of_frame =
            stored.page_of_frame.emplace_back(source_->page_of_frame(picture.stimulus));
        const int pages = 1 + std::ranges::max(page_of_frame);
        for (int& page : page_of_frame)
            page += stored.pages;
        stored.first_page.push_back(stored.pages);
        stored.pages += pages;
    }
    stored.turns = turns_of(stored);
    const int layers = stored.turns.layers;
    if (!stored.textures || stored.textures->layers() < layers ||
        !fits_beside_current(stored.textures->layers())) {
        stored.textures.reset();
        stored.textures.emplace(*context_, layer_px_, layers, encoder_->format());
    }
    if (!staging_)
        staging_.emplace(*context_, staged_pages(), page_bytes());
    expected_ = stored.pictures;
    loader_ = loader_of(stored, threads);
}

PageTurns FrameStore::turns_of(const StoredStimuli& stored) const {
    PageTurns turns;
    const auto room = static_cast<int>(std::min<std::size_t>(budget_bytes_ / page_bytes(), 1'000'000));
    if (stored.pages <= room) {
        turns.pages.resize(static_cast<std::size_t>(stored.pages));
        std::iota(turns.pages.begin(), turns.pages.end(), 0);
        turns.layers = stored.pages;
        return turns;
    }
    if (stored.pictures.size() > 1 || room < least_streamed_pages) {
        const std::size_t bytes = page_bytes() * static_cast<std::size_t>(stored.pages);
        throw InputError(
            fmt::format("{} {:.0f} MB in the frame store, which may take {:.0f}: "
                        "allow more with display.frame_store_mb, or show fewer or smaller frames",
                        stored.pictures.size() == 1 ? "a stimulus takes" : "the stimuli of a trial take",
                        1e-6 * static_cast<double>(bytes), 1e-6 * static_cast<double>(budget_bytes_)));
    }
    turns.pages = stored.page_of_frame.front();
    turns.pages.erase(std::ranges::unique(turns.pages).begin(), turns.pages.end());
    if (turns.pages.size() > 1 && turns.pages.front() == turns.pages.back())
        turns.pages.pop_back();
    turns.layers = room;
    turns.go_round = true;
    return turns;
}

std::unique_ptr<PageLoader> FrameStore::loader_of(const StoredStimuli& stored, int threads,
                                                  std::int64_t first_turn) {
    return std::make_unique<PageLoader>(
        *staging_, stored.turns,
        [this, of = stored.pictures, first_page = stored.first_page](int page, LinearImage& room,
                                                                     std::span<std::byte> into) {
            const auto after = std::ranges::upper_bound(first_page, page) - first_page.begin();
            const auto index = static_cast<std::size_t>(after - 1);
            const auto slot = static_cast<std::size_t>(of[index].slot);
            const LinearImage& picture =
                source_->read_page(of[index].stimulus, page - first_page[index], room);
            OVERT_EXPECTS(picture.size_px == slots_[slot].size_px);
            const glm::ivec2 size_px = patches_[slot].size_px;
            encoder_->encode(picture, slots_[slot].origin_px,
                             into.first(bytes_in(size_px, encoder_->format())));
            return size_px;
        },
        threads, first_turn);
}

void FrameStore::stream_from(std::int64_t turn) {
    const StoredStimuli& stored = stored_[current_];
    stream_.reset(); // before the next one begins: both use the staging memory
    stream_ = loader_of(stored, threads_beside_a_session(), turn);
    while (stream_->hand_over_one(current_textures(), PageLoader::Wait::yes))
        ;
}

int FrameStore::layer_of(int page) {
    if (!stream_)
        return page;
    std::optional<std::int64_t> turn = stream_->turn_of(page, stream_->turn());
    OVERT_EXPECTS(turn);
    if (*turn >= stream_->turn() + stream_->turns().layers) {
        // Far from what is kept: pages are asked for in another order than they are shown.
        turn = *turn % stream_->turns().round();
        stream_from(*turn);
    }
    stream_->let_go_before(*turn);
    while (!stream_->has(*turn))
        stream_->hand_over_one(current_textures(), PageLoader::Wait::yes);
    return stream_->turns().layer(*turn);
}

void FrameStore::stream_on() noexcept {
    if (!stream_)
        return;
    try {
        stream_->hand_over_one(current_textures(), PageLoader::Wait::no);
    } catch (...) {
        // Thrown again by layer_of(), should the page be shown.
    }
}

void FrameStore::rewind() {
    if (!stream_)
        return;
    if (stream_->turn() % stream_->turns().round() != 0) {
        stream_from(0);
        return;
    }
    while (stream_->hand_over_one(current_textures(), PageLoader::Wait::yes))
        ;
}

void FrameStore::forget_expected() {
    loader_.reset();
    expected_.reset();
    failure_ = nullptr;
}

const StoredStimuli& FrameStore::load(std::span<const PlacedStimulus> shown) {
    const std::vector<SlotPicture> pictures = pictures_of(shown);
    if (is_current(pictures)) {
        rewind();
        return stored_[current_];
    }
    stream_.reset();
    if (failure_ && is_expected(pictures)) {
        const std::exception_ptr failure = failure_;
        forget_expected();
        std::rethrow_exception(failure);
    }
    if (!is_expected(pictures)) {
        forget_expected();
        if (!fits_beside_current(pages_of(pictures))) {
            // They take the place of those that were shown.
            spare().textures.reset();
            current_ = 1 - current_;
            is_loaded_ = false;
        }
        begin(pictures, processors());
    }
    if (loader_) {
        try {
            while (loader_->hand_over_one(*spare().textures, PageLoader::Wait::yes))
                ;
        } catch (...) {
            forget_expected();
            throw;
        }
        if (loader_->turns().go_round)
            stream_ = std::move(loader_);
        loader_.reset();
    }
    context_->gl().Finish();
    throw_on_gl_error(*context_, "filling the frame store");
    expected_.reset();
    current_ = 1 - current_;
    is_loaded_ = true;
    return stored_[current_];
}

void FrameStore::expect(std::span<const PlacedStimulus> shown) noexcept {
    std::vector<SlotPicture> pictures;
    try {
        pictures = pictures_of(shown);
        if (is_current(pictures) || is_expected(pictures))
            return;
        forget_expected();
        if (!stream_ && fits_beside_current(pages_of(pictures)))
            begin(pictures, threads_beside_a_session());
    } catch (...) {
        failure_ = std::current_exception();
        expected_ = std::move(pictures);
    }
}

void FrameStore::use_spare_time() noexcept {
    stream_on();
    if (!loader_ || failure_)
        return;
    try {
        loader_->hand_over_one(*spare().textures, PageLoader::Wait::no);
        if (loader_->is_full())
            loader_.reset();
    } catch (...) {
        failure_ = std::current_exception();
    }
}

} // namespace overt
