/// Reads and encodes the pages of one stimulus on threads of its own, while the thread of the context hands
/// them over to the card.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "render/image/linear_image.h"
#include "render/presenter/page_staging.h"

namespace overt {

class PageLoader {
  public:
    /// Writes the bytes of a page to the begin of `into`, by way of a picture that is used again for further
    /// pages, and gives its columns and rows. Called from several threads at once; may throw.
    using FillPage = std::function<glm::ivec2(int page, LinearImage& by_way_of, std::span<std::byte> into)>;

    /// Begins at once, with at most `threads` threads. `staging` must outlive this, and nobody else use it
    /// meanwhile.
    PageLoader(PageStaging& staging, int pages, FillPage fill, int threads);
    /// Waits for pages that are being read; begins no further ones.
    ~PageLoader();

    /// Hands pages that are ready over to the texture array: one of them if any is, and with `all`, waiting,
    /// every one that is missing. What a page threw is thrown here. Thread of the context.
    void hand_over(TextureArray& to, bool all);

    /// Every page was handed over.
    bool is_done() const { return handed_over_ == pages_; }

  private:
    struct ReadyPage {
        int place, page;
        glm::ivec2 size_px{0};
    };
    void work();
    std::optional<ReadyPage> take_ready(bool wait);

    PageStaging* staging_;
    int pages_;
    FillPage fill_;
    int handed_over_ = 0; ///< by the context's thread alone
    std::mutex mutex_;
    std::condition_variable place_freed_, page_ready_;
    // Behind the mutex:
    int next_page_ = 0;
    bool stopping_ = false;
    std::vector<int> free_places_;
    std::vector<ReadyPage> ready_;
    std::exception_ptr failure_;
    std::vector<std::jthread> threads_; ///< last, so that they end first
};

} // namespace overt
