// What one step of a job cost. Of steps that run at the same time each has the costs of all.
#pragma once

#include <string>
#include <vector>

namespace talus {

struct Stage {
  std::string name;
  double wall_s = 0;   // time passed
  double cpu_s = 0;    // processor time of the whole process, all threads
  double peak_mb = 0;  // most memory the process ever held until the step's end, MiB
  bool cached = false;
  std::vector<Stage> phases;  // what it consists of, as far as that is measured
};

// Runs from its construction.
class StageTimer {
 public:
  StageTimer();
  // What has passed until now. May be called again.
  Stage stop(std::string name, bool cached = false) const;

 private:
  double wall_s_;
  double cpu_s_;
};

}  // namespace talus
