#include "comparison/pareto_front.h"

#include <algorithm>
#include <limits>

namespace heightlight {

std::vector<const ComparisonRow*> pareto_front(const std::vector<ComparisonRow>& rows,
                                               const std::string& quantity) {
  std::vector<const ComparisonRow*> candidates;
  for (const ComparisonRow& row : rows) {
    if (row.quantity == quantity && row.method != kExactMethod) candidates.push_back(&row);
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const ComparisonRow* a, const ComparisonRow* b) {
    return a->cost.core < b->cost.core;
  });
  std::vector<const ComparisonRow*> front;
  double least = std::numeric_limits<double>::infinity();
  for (const ComparisonRow* row : candidates) {
    if (row->error.rmse >= least) continue;
    least = row->error.rmse;
    front.push_back(row);
  }
  return front;
}

const ComparisonRow* cheapest(const std::vector<ComparisonRow>& rows, const std::string& quantity,
                              double error) {
  for (const ComparisonRow* row : pareto_front(rows, quantity)) {
    if (row->error.rmse <= error) return row;
  }
  return nullptr;
}

}  // namespace heightlight
