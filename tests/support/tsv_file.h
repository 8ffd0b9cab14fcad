/// A tab-separated table, read back without the program's own code.
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <filesystem>

namespace overt::test {

class TsvFile {
  public:
    explicit TsvFile(const std::filesystem::path& file) {
        std::ifstream stream(file);
        std::string line;
        if (!std::getline(stream, line))
            throw std::runtime_error(file.string() + " is no table");
        const std::vector<std::string> names = cells_of(line);
        for (std::size_t i = 0; i < names.size(); ++i)
            columns_[names[i]] = i;
        while (std::getline(stream, line)) {
            rows_.push_back(cells_of(line));
            if (rows_.back().size() != names.size())
                throw std::runtime_error(file.string() + " has a row of another length");
        }
    }

    std::size_t size() const { return rows_.size(); }
    const std::string& text(std::size_t row, const std::string& column) const {
        return rows_.at(row).at(columns_.at(column));
    }
    bool has(std::size_t row, const std::string& column) const { return text(row, column) != "n/a"; }
    double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }
    long integer(std::size_t row, const std::string& column) const { return std::stol(text(row, column)); }

  private:
    static std::vector<std::string> cells_of(const std::string& line) {
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, '\t');)
            cells.push_back(cell);
        if (line.ends_with('\t'))
            cells.emplace_back();
        return cells;
    }

    std::map<std::string, std::size_t> columns_;
    std::vector<std::vector<std::string>> rows_;
};

} // namespace overt::test
