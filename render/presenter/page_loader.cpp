#include "render/presenter/page_loader.h"

#include <algorithm>
#include <numeric>

namespace overt {

PageLoader::PageLoader(PageStaging& staging, PageTurns turns, FillPage fill, int threads, std::int64_t first)
    : staging_(&staging), turns_(std::move(turns)), fill_(std::move(fill)), first_(first), turn_(first),
      in_layer_(static_cast<std::size_t>(turns_.layers), -1), next_turn_(first),
      free_places_(static_cast<std::size_t>(staging.places())) {
    std::iota(free_places_.begin(), free_places_.end(), 0);
    ready_.reserve(free_places_.size());
    const int pages = static_cast<int>(turns_.pages.size());
    for (int i = 0; i < std::min({threads, pages, staging.places()}); ++i)
        threads_.emplace_back([this] { work(); });
}

PageLoader::~PageLoader() {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
    place_freed_.notify_all();
}

void PageLoader::work() {
    LinearImage picture;
    std::unique_lock lock(mutex_);
    const auto is_over = [&] { return stopping_ || (!turns_.go_round && next_turn_ == turns_.round()); };
    while (true) {
        place_freed_.wait(lock, [&] { return is_over() || !free_places_.empty(); });
        if (is_over())
            return;
        ReadyPage mine{free_places_.back(), next_turn_++};
        free_places_.pop_back();
        lock.unlock();
        std::exception_ptr failure;
        try {
            mine.size_px = fill_(turns_.page(mine.turn), picture, staging_->open(mine.place));
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure) {
            failure_ = failure;
            stopping_ = true;
            place_freed_.notify_all();
        } else {
            ready_.push_back(mine);
        }
        page_ready_.notify_all();
    }
}

std::int64_t PageLoader::end_of_room() const {
    return turns_.go_round ? turn_ + turns_.layers : turns_.round();
}

std::optional<PageLoader::ReadyPage> PageLoader::take_ready(Wait wait) {
    std::unique_lock lock(mutex_);
    const std::int64_t end = end_of_room();
    const auto earliest = [&] { return std::ranges::min_element(ready_, {}, &ReadyPage::turn); };
    const auto has_one = [&] { return !ready_.empty() && earliest()->turn < end; };
    if (wait == Wait::yes)
        page_ready_.wait(lock, [&] { return failure_ || has_one(); });
    if (failure_)
        std::rethrow_exception(failure_);
    if (!has_one())
        return std::nullopt;
    const auto taken = earliest();
    const ReadyPage page = *taken;
    ready_.erase(taken);
    return page;
}

bool PageLoader::hand_over_one(TextureArray& to, Wait wait) {
    if (is_full())
        return false;
    const std::optional<ReadyPage> ready = take_ready(wait);
    if (!ready)
        return false;
    // Where it is late, its layer may have the page of the next round already.
    if (ready->turn >= turn_) {
        staging_->hand_over(ready->place, to, turns_.layer(ready->turn), ready->size_px);
        in_layer_[static_cast<std::size_t>(turns_.layer(ready->turn))] = ready->turn;
    }
    ++handed_over_;
    {
        const std::scoped_lock lock(mutex_);
        free_places_.push_back(ready->place);
    }
    place_freed_.notify_all();
    return true;
}

std::optional<std::int64_t> PageLoader::turn_of(int page, std::int64_t from) const {
    for (std::int64_t turn = from; turn < from + turns_.round(); ++turn)
        if (turns_.page(turn) == page)
            return turn;
    return std::nullopt;
}

void PageLoader::let_go_before(std::int64_t turn) { turn_ = std::max(turn_, turn); }

} // namespace overt
