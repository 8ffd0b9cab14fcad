/// Reads and encodes pages on threads of its own, while the thread of the context hands them over to the
/// card.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "render/image/linear_image.h"
#include "render/presenter/page_staging.h"

namespace overt {

/// In which order pages are needed, and what room there is for them. A page's turn counts on from 0 round
/// after round; the n-th turn goes to layer n modulo `layers`.
struct PageTurns {
    std::vector<int> pages; ///< of one round, at least one
    int layers = 0;         ///< at least one; as many as there are pages, or, if they go round, fewer
    bool go_round = false;  ///< without an end, else once

    int page(std::int64_t turn) const { return pages[static_cast<std::size_t>(turn % round())]; }
    int layer(std::int64_t turn) const { return static_cast<int>(turn % layers); }
    std::int64_t round() const { return static_cast<std::int64_t>(pages.size()); }
};

class PageLoader {
  public:
    /// Writes the bytes of a page to the begin of `into`, by way of a picture that is used again for further
    /// pages, and gives its columns and rows. Called from several threads at once; may throw.
    using FillPage = std::function<glm::ivec2(int page, LinearImage& by_way_of, std::span<std::byte> into)>;

    /// Begins at once with the turn `first`, with at most `threads` threads. `staging` must outlive this, and
    /// nobody else use it meanwhile.
    PageLoader(PageStaging& staging, PageTurns turns, FillPage fill, int threads, std::int64_t first = 0);
    /// Waits for pages that are being read; begins no further ones.
    ~PageLoader();

    enum class Wait : std::uint8_t { no, yes };
    /// Hands the earliest page that is ready over to its layer of the texture array, if that is free; one
    /// that was let go meanwhile is dropped. What a page threw is thrown here, again and again. Thread of the
    /// context.
    ///
    /// Gives whether there was one; with Wait::yes it waits for it, unless all are there that have room.
    bool hand_over_one(TextureArray& to, Wait wait);

    /// The turn's page is in its layer.
    bool has(std::int64_t turn) const {
        return in_layer_[static_cast<std::size_t>(turns_.layer(turn))] == turn;
    }
    /// The earliest turn from `from` on, within a round, at which a page is needed; nothing if it never is.
    std::optional<std::int64_t> turn_of(int page, std::int64_t from) const;

    /// The turns before this one are over, their layers free. Thread of the context.
    void let_go_before(std::int64_t turn);
    /// The earliest turn that is kept.
    std::int64_t turn() const { return turn_; }
    const PageTurns& turns() const { return turns_; }

    /// All pages that have room are in their layers.
    bool is_full() const { return handed_over_ == end_of_room() - first_; }

  private:
    struct ReadyPage {
        int place;
        std::int64_t turn;
        glm::ivec2 size_px{0};
    };
    void work();
    std::int64_t end_of_room() const;
    std::optional<ReadyPage> take_ready(Wait wait);

    PageStaging* staging_;
    const PageTurns turns_;
    FillPage fill_;
    const std::int64_t first_;
    // By the context's thread alone:
    std::int64_t turn_, handed_over_ = 0;
    std::vector<std::int64_t> in_layer_; ///< the turn whose page a layer has; -1: none
    std::mutex mutex_;
    std::condition_variable place_freed_, page_ready_;
    // Behind the mutex:
    std::int64_t next_turn_;
    bool stopping_ = false;
    std::vector<int> free_places_;
    std::vector<ReadyPage> ready_;
    std::exception_ptr failure_;
    std::vector<std::jthread> threads_; ///< last, so that they end first
};

} // namespace overt
