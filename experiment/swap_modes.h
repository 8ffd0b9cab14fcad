/// How pictures of a window came to the screen, as the server that put them there tells of it.
#pragma once

namespace overt {

/// Counts of pictures, by what became of each.
struct SwapModes {
    int flipped = 0;           ///< its memory was scanned out itself, from a vertical blank on
    int copied = 0;            ///< it was copied into what is scanned out, while that may have been going on
    int suboptimal_copied = 0; ///< likewise, where other buffers could have been flipped to
    int skipped = 0;           ///< another replaced it before it was shown

    int all_copied() const { return copied + suboptimal_copied; }
    int all() const { return flipped + all_copied() + skipped; }
    friend bool operator==(const SwapModes&, const SwapModes&) = default;
    friend SwapModes operator+(const SwapModes& a, const SwapModes& b) {
        return {a.flipped + b.flipped, a.copied + b.copied, a.suboptimal_copied + b.suboptimal_copied,
                a.skipped + b.skipped};
    }
};

} // namespace overt
