#include "tools/posing/operation_table.h"

#include <utility>

namespace retarget::posing {
namespace {

using Table = std::array<OperationRow, std::variant_size_v<Operation>>;
static_assert(std::tuple_size_v<decltype(SolverRows())> + std::tuple_size_v<decltype(HandRows())> +
                      std::tuple_size_v<decltype(ContentRows())> ==
                  std::tuple_size_v<Table>,
              "every operation has one row");

template <typename Rows>
void Place(Rows rows, Table* table) {
  for (OperationRow& row : rows) (*table)[row.index] = std::move(row);
}

}  // namespace

const Table& OperationTable() {
  static const Table table = [] {
    Table all;
    Place(SolverRows(), &all);
    Place(HandRows(), &all);
    Place(ContentRows(), &all);
    return all;
  }();
  return table;
}

const std::array<HistoryRow, 2>& HistoryTable() {
  static const std::array<HistoryRow, 2> table = {
      {{"undo", "take the last operation back", HistoryStep::kUndo},
       {"redo", "do it again", HistoryStep::kRedo}}};
  return table;
}

}  // namespace retarget::posing
