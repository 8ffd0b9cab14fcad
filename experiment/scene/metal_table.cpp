#include "experiment/scene/metal_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// One line of the table: index at a wavelength.
struct MetalRow {
    double wavelength_nm = 0.0, n = 0.0, k = 0.0;
};

/// Which column holds what.
struct MetalColumns {
    std::size_t wavelength = 0, n = 0, k = 0;
    double nm_per_unit = 1.0;
    bool are_bins = false;
};

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t comma = line.find(',');
        std::string_view cell = line.substr(0, comma);
        while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t'))
            cell.remove_prefix(1);
        while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r'))
            cell.remove_suffix(1);
        cells.push_back(cell);
        if (comma == std::string_view::npos)
            return cells;
        line.remove_prefix(comma + 1);
    }
}

class MetalFile {
  public:
    explicit MetalFile(const std::filesystem::path& file) : file_(file), input_(file) {
        if (!input_)
            throw InputError(fmt::format("{}: cannot be read as a table of a metal", file.string()));
    }

    ComplexIndex read() {
        while (next_line())
            columns_ ? add_row() : read_header();
        if (!columns_)
            fail("there is no line that names the columns: wavelength_nm,n,k");
        return columns_->are_bins ? bins_as_they_are() : bin_means();
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(fmt::format("{}:{}: {}", file_.string(), line_number_, message));
    }

    bool next_line() {
        while (std::getline(input_, line_)) {
            ++line_number_;
            if (line_.find_first_not_of(" \t\r") != std::string::npos && line_.front() != '#')
                return true;
        }
        return false;
    }

    void read_header() {
        const std::vector<std::string_view> names = cells_of(line_);
        const auto column = [&](std::string_view name) -> std::optional<std::size_t> {
            const auto found = std::find(names.begin(), names.end(), name);
            return found == names.end() ? std::nullopt
                                        : std::optional(static_cast<std::size_t>(found - names.begin()));
        };
        MetalColumns columns;
        if (const auto centre = column("centre_nm")) {
            columns.wavelength = *centre;
            columns.are_bins = true;
        } else if (const auto nm = column("wavelength_nm")) {
            columns.wavelength = *nm;
        } else if (const auto um = column("wavelength_um")) {
            columns.wavelength = *um;
            columns.nm_per_unit = 1000.0;
        } else {
            fail("no column is called centre_nm, wavelength_nm or wavelength_um");
        }
        const auto n = column("n"), k = column("k");
        if (!n || !k)
            fail("the columns n and k are needed: refractive index and extinction coefficient");
        columns.n = *n;
        columns.k = *k;
        columns_ = columns;
    }

    double number(const std::vector<std::string_view>& cells, std::size_t column) const {
        if (column >= cells.size())
            fail(fmt::format("the line has {} columns only", cells.size()));
        double value = 0.0;
        const std::string_view cell = cells[column];
        const auto parsed = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (parsed.ec != std::errc() || parsed.ptr != cell.data() + cell.size() || !std::isfinite(value))
            fail(fmt::format("«{}» is no number", cell));
        return value;
    }

    void add_row() {
        const std::vector<std::string_view> cells = cells_of(line_);
        const MetalRow row{number(cells, columns_->wavelength) * columns_->nm_per_unit,
                           number(cells, columns_->n), number(cells, columns_->k)};
        if (row.n < 0.0 || row.k < 0.0 || row.n > 100.0 || row.k > 100.0 || row.n + row.k == 0.0)
            fail("n and k of a metal lie between 0 and 100, and are not both 0");
        if (!rows_.empty() && row.wavelength_nm <= rows_.back().wavelength_nm)
            fail("wavelengths must rise from line to line");
        if (columns_->are_bins &&
            row.wavelength_nm != first_bin_centre_nm + bin_width_nm * static_cast<double>(rows_.size()))
            fail("the centres must be 400, 410 … 700 nm; name the column wavelength_nm for others");
        rows_.push_back(row);
    }

    ComplexIndex bins_as_they_are() const {
        if (rows_.size() != spectral_bins)
            fail(fmt::format("{} bins, but 31 are needed: 400, 410 … 700 nm", rows_.size()));
        ComplexIndex metal;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            metal.n[bin] = rows_[bin].n;
            metal.k[bin] = rows_[bin].k;
        }
        return metal;
    }

    ComplexIndex bin_means() const {
        const double low = first_bin_centre_nm - 0.5 * bin_width_nm;
        const double high = low + bin_width_nm * spectral_bins;
        if (rows_.empty() || rows_.front().wavelength_nm > low || rows_.back().wavelength_nm < high)
            fail(fmt::format("the wavelengths do not cover {} to {} nm", low, high));
        ComplexIndex metal;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            const double from = low + bin_width_nm * static_cast<double>(bin);
            metal.n[bin] = mean_between(from, from + bin_width_nm, &MetalRow::n);
            metal.k[bin] = mean_between(from, from + bin_width_nm, &MetalRow::k);
        }
        return metal;
    }

    double mean_between(double low, double high, double MetalRow::*value) const {
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
            const MetalRow &a = rows_[i], &b = rows_[i + 1];
            const double from = std::max(low, a.wavelength_nm), to = std::min(high, b.wavelength_nm);
            if (from >= to)
                continue;
            const double share = (0.5 * (from + to) - a.wavelength_nm) / (b.wavelength_nm - a.wavelength_nm);
            sum += (to - from) * (a.*value + share * (b.*value - a.*value));
        }
        return sum / (high - low);
    }

    std::filesystem::path file_;
    std::ifstream input_;
    std::string line_;
    int line_number_ = 0;
    std::optional<MetalColumns> columns_;
    std::vector<MetalRow> rows_;
};

} // namespace

bool is_metal_file(const std::string& metal) { return std::filesystem::path(metal).extension() == ".csv"; }

ComplexIndex read_metal_table(const std::filesystem::path& file) { return MetalFile(file).read(); }

ComplexIndex load_metal(const std::string& metal) {
    return is_metal_file(metal) ? read_metal_table(metal) : metal_index(metal);
}

} // namespace overt
