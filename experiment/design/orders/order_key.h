/// A name for what can follow from a place, in which the names of levels play no part.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/design/orders/order_history.h"
#include "experiment/design/orders/order_kinds.h"

namespace overt {

/// Makes keys of places; keeps its work space, so one thread at a time.
///
/// Which level is called what makes no difference to a limit: a place and one that differs from it only by
/// renaming levels can be gone on from in the same number of ways. So levels are renamed by what they are
/// like: their marks, and what is left of the kinds that have them, refined in turn as in the colouring of
/// graphs (Weisfeiler and Leman 1968). Levels of a single factor that are still alike are interchangeable;
/// with several factors one of them is told apart and the refinement goes on. Any naming is sound: at worst,
/// two equal places have different keys and are counted twice.
class OrderKeys {
  public:
    explicit OrderKeys(const OrderKinds& kinds);

    /// `counts` by kind: what is left in the segment that is being filled; empty if none is. `head` comes
    /// first in the key.
    std::u16string key_of(const std::u16string& head, const std::vector<int>& counts, int part,
                          const OrderHistory& history);

  private:
    struct Level {
        std::uint64_t colour = 0;
        std::uint64_t next = 0;
        int mark = 0;
        int name = 0;
        bool is_active = false;
    };
    struct Active {
        int kind;
        std::uint32_t worth;
    };
    void colour(int part, const std::vector<int>& counts, const OrderHistory& history);
    void refine(int rounds);
    bool tell_one_apart(std::uint64_t step);
    void name_levels();
    Level& level(std::size_t kind, std::size_t factor) {
        return levels_[static_cast<std::size_t>(level_of_[kind * factors_ + factor])];
    }

    const OrderKinds& kinds_;
    std::size_t factors_;
    std::vector<int> level_of_;            ///< by kind and limited factor: index into levels_
    std::vector<std::size_t> first_level_; ///< by limited factor, and one more for the end
    std::vector<Level> levels_;
    std::vector<Active> active_;
    std::vector<std::uint64_t> sorted_;
    std::vector<int> by_colour_;
};

} // namespace overt
