#include "experiment/scene/making/orientation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace overt {
namespace {

/// A sum of doubles that is exact, as the doubles it is made of, which do not overlap, the largest last.
class ExactSum {
  public:
    /// Adds a product without rounding it.
    void add_product(double x, double y) noexcept {
        const double product = x * y;
        add(std::fma(x, y, -product));
        add(product);
    }
    int sign() const noexcept {
        const double largest = size_ > 0 ? terms_[size_ - 1] : 0.0;
        return (largest > 0.0) - (largest < 0.0);
    }

  private:
    // Grow-Expansion (Shewchuk 1997, fig. 6), with zeros left out.
    void add(double value) noexcept {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const double sum = value + terms_[i];
            const double of_term = sum - value;
            const double rest = (value - (sum - of_term)) + (terms_[i] - of_term);
            value = sum;
            if (rest != 0.0)
                terms_[kept++] = rest;
        }
        if (value != 0.0)
            terms_[kept++] = value;
        size_ = kept;
    }

    std::array<double, 12> terms_{};
    std::size_t size_ = 0;
};

} // namespace

int orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) noexcept {
    const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    const double area = left - right;
    constexpr double half_ulp = 0.5 * std::numeric_limits<double>::epsilon();
    constexpr double doubt = (3.0 + 16.0 * half_ulp) * half_ulp; // "ccwerrboundA"
    if (std::abs(area) > doubt * (std::abs(left) + std::abs(right)))
        return area > 0.0 ? 1 : -1;
    ExactSum twice_area;
    twice_area.add_product(a.x, b.y);
    twice_area.add_product(-a.y, b.x);
    twice_area.add_product(b.x, c.y);
    twice_area.add_product(-b.y, c.x);
    twice_area.add_product(c.x, a.y);
    twice_area.add_product(-c.y, a.x);
    return twice_area.sign();
}

} // namespace overt
