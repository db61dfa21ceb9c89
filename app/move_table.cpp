// polybed move-table: what --stress-uncertainty asks for.
#include "app/options.hpp"
#include "multiscale/calibrate/moved_table.hpp"

namespace polybed::app {

void run_move_table(const MoveOptions& options) { write_moved_table(options.table, options.sigma, options.moved); }

}  // namespace polybed::app
