#pragma once

#include "store/database/sqlite.h"
#include "tests/support/paths.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace abut::test {

/// Runs the SQL queries that a page of docs/ shows below its mark <!-- sql --> on a store. Returns
/// the number of rows of each SELECT.
inline std::vector<int> rows_of_page_queries(const std::string& page, const std::string& store) {
    std::ifstream file(std::string(ABUT_SOURCE_DIR) + "/docs/" + page);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t mark = text.find("<!-- sql -->");
    if (mark == std::string::npos) {
        ADD_FAILURE() << page << " has no mark";
        return {};
    }
    const std::size_t start = text.find("```sql\n", mark) + 7;
    std::istringstream sql(text.substr(start, text.find("```", start) - start));
    Database database(store, OpenMode::read_only);
    std::vector<int> rows;
    for (std::string statement; std::getline(sql, statement, ';');) {
        if (statement.find("SELECT") == std::string::npos)
            continue;
        Statement question(database, statement);
        rows.push_back(0);
        while (question.step())
            ++rows.back();
    }
    return rows;
}

} // namespace abut::test
