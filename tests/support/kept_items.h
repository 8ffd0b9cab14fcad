/// A sink of a tracker's items that keeps them, for tests of drivers.
#pragma once

#include <vector>

#include "devices/tracker/tracker_driver.h"

namespace overt::test {

class KeptItems final : public TrackerItemSink {
  public:
    void put(const TrackerItem& item) noexcept override { items.push_back(item); }
    template <class Item> std::vector<Item> all() const {
        std::vector<Item> some;
        for (const TrackerItem& item : items)
            if (const auto* one = std::get_if<Item>(&item))
                some.push_back(*one);
        return some;
    }
    std::vector<TrackerItem> items;
};

} // namespace overt::test
