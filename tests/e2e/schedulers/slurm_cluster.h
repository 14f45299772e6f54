#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/programs.h"

namespace swath::test {

// A Slurm cluster on this machine, run by the test's user: munged, slurmctld, and a slurmd for each of the
// nodes n1, n2, and so on. Files, sockets and keys are in a folder of the test; ports are free ones. Every
// node claims to have four CPUs. Node i is at 127.0.0.i. All ends with the object, jobs included.
class SlurmCluster {
  public:
    // Names what is not installed, and how to get it; empty if all is there.
    static std::string missing();

    SlurmCluster(const std::filesystem::path& folder, int nodes);
    ~SlurmCluster();
    SlurmCluster(const SlurmCluster&) = delete;
    SlurmCluster& operator=(const SlurmCluster&) = delete;

    // Submits docker/slurm/swath.sbatch from a folder and returns the job's number.
    std::string submit(const std::filesystem::path& folder, const Arguments& sbatch, const Arguments& swath,
                       std::vector<std::string> environment = {}) const;
    void cancel(const std::string& job) const;
    // Waits until nothing of the job runs and returns its state and exit code: "COMPLETED 0:0".
    std::string end_of(const std::string& job) const;

  private:
    Finished run(const std::string& program, const Arguments& arguments,
                 std::vector<std::string> environment = {}, const std::filesystem::path& folder = {}) const;

    std::string configuration_;
    std::vector<std::unique_ptr<Process>> daemons_;
};

// Asks repeatedly, up to a limit, until the condition is true.
bool eventually(const std::function<bool()>& condition, std::chrono::milliseconds limit = kPatience);

}  // namespace swath::test
