/// Memory of the graphics card that other threads may write pages into, on their way to a texture.
#pragma once

#include <span>
#include <vector>

#include "render/gl/gl_objects.h"

namespace overt {

/// A row of equally large places. Made, emptied and destroyed with the context current; what open() gave may
/// be written to from any thread until it is handed over.
class PageStaging {
  public:
    /// Throws GraphicsError if the card has no room for them.
    PageStaging(const GlContext& context, int places, std::size_t bytes_each);
    ~PageStaging();
    PageStaging(PageStaging&&) = delete;

    int places() const { return static_cast<int>(open_.size()); }
    std::size_t bytes_each() const { return bytes_each_; }

    /// The memory of a place.
    std::span<std::byte> open(int place) const { return open_[static_cast<std::size_t>(place)]; }

    /// Sends the `size_px` columns and rows that were written to a place to the top left of a layer of a
    /// texture array, and opens the place anew. The card copies when it gets to it. Throws GraphicsError.
    void hand_over(int place, TextureArray& to, int layer, glm::ivec2 size_px);

  private:
    void map(std::size_t place);
    void unmap(std::size_t place) const noexcept;

    const GlContext* context_;
    std::size_t bytes_each_;
    std::vector<Buffer> buffers_;
    std::vector<std::span<std::byte>> open_;
};

} // namespace overt
