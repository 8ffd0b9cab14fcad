// Where drawn changes are found; tests/mutants/check asks for those that each line says at its end, and for
// no others.
#include <vector>

#include <cassert>

namespace sample {

constexpr double share = 0.25; // constant

static int beyond(int first, int second) {
    if (first < second)   // bound comparison condition
        return first - 2; // arithmetic constant term
    first += 3;           // arithmetic constant statement
    return -first;        // sign
}

static bool is_between(double value, double low, double high) {
    return value >= low && value <= high; // and-or bound bound comparison comparison returned
}

static double sum_of(const std::vector<double>& values) {
    double sum = 0.0; // constant
    for (const double value : values) {
        if (value == 3.0) // comparison condition constant
            continue;
        sum += share * value; // arithmetic arithmetic statement term
    }                         // loop
    return sum;
}

static int use(const std::vector<double>& values) {
    static_assert(sizeof(int) > 2);
    assert(values.size() > 1);
    const bool is_in = is_between(sum_of(values), 0.5, 1.5); // arguments arguments constant constant
    const int many = 7 + beyond(1, 7);  // arguments arithmetic constant constant constant term
    return is_in ? beyond(1, 2) : many; // arguments condition constant constant
}

} // namespace sample

int main() { return sample::use({1.0, 2.0, 3.0}); } // constant constant constant
