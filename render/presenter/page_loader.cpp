#include "render/presenter/page_loader.h"

#include <algorithm>
#include <numeric>

namespace overt {

PageLoader::PageLoader(PageStaging& staging, int pages, FillPage fill, int threads)
    : staging_(&staging), pages_(pages), fill_(std::move(fill)),
      free_places_(static_cast<std::size_t>(staging.places())) {
    std::iota(free_places_.begin(), free_places_.end(), 0);
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
    while (true) {
        place_freed_.wait(lock, [&] { return stopping_ || next_page_ == pages_ || !free_places_.empty(); });
        if (stopping_ || next_page_ == pages_)
            return;
        ReadyPage mine{free_places_.back(), next_page_++};
        free_places_.pop_back();
        lock.unlock();
        std::exception_ptr failure;
        try {
            mine.size_px = fill_(mine.page, picture, staging_->open(mine.place));
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

std::optional<PageLoader::ReadyPage> PageLoader::take_ready(bool wait) {
    std::unique_lock lock(mutex_);
    if (wait)
        page_ready_.wait(lock, [&] { return failure_ || !ready_.empty(); });
    if (failure_)
        std::rethrow_exception(failure_);
    if (ready_.empty())
        return std::nullopt;
    const ReadyPage page = ready_.back();
    ready_.pop_back();
    return page;
}

void PageLoader::hand_over(TextureArray& to, bool all) {
    while (!is_done()) {
        const std::optional<ReadyPage> ready = take_ready(all);
        if (!ready)
            return;
        staging_->hand_over(ready->place, to, ready->page, ready->size_px);
        ++handed_over_;
        {
            const std::scoped_lock lock(mutex_);
            free_places_.push_back(ready->place);
        }
        place_freed_.notify_all();
        if (!all)
            return;
    }
}

} // namespace overt
