#pragma once
#include <array>
#include <list>
#include <string>
#include <vector>

#include "sim/experiment/experiment.h"
#include "sim/page/page.h"
#include "sim/plot/plot.h"
#include "sim/studies/study.h"

namespace swath::sim {

// The paper compares MAHD and sort-last with the hybrid.
inline constexpr std::array kPaperAlgorithms{Algorithm::kMahd, Algorithm::kHybrid, Algorithm::kSortLast};
inline constexpr int kPaperWidth = 1280;
inline constexpr int kPaperHeight = 960;
inline constexpr int kPaperDepth = 4;  // depth of the octree that cuts a model into objects
inline constexpr std::array<std::size_t, 4> kPaperServers{8, 16, 32, 64};

// An algorithm's name in tables: "sort-first" is the paper's, MAHD.
std::string table_name(Algorithm algorithm);

// Makes a part of a file's name, and of a link to it: plain characters stay, others become "~2f". Different
// texts give different names.
std::string file_name_of(std::string_view text);
// The cell's text for of / by; a dash if `by` is 0.
std::string quotient(double of, double by, int decimals);

// A model of the studies.
struct StudySubject {
    StudyModel model;  // cut at kPaperDepth
    std::string file;
    std::string paper_name;  // the paper's model that it is or stands for; may be empty
    bool stand_in = false;
    double zoom = 1;
    Paths paths;  // with the paper's aspect
};

// Experiments and their outcomes.
struct Results {
    std::vector<Experiment> experiments;
    std::vector<Outcome> outcomes;
    // A column of paper mode (table1, client, effective_frame) or full mode. CHECKs that it is there.
    double value(Algorithm algorithm, const std::string& model, std::size_t servers,
                 std::string_view column) const;
    std::vector<Row> rows() const;  // all_rows() of all experiments
};

// The studies share this: models, hardware, the page, and the results that several of them need.
class StudyContext {
  public:
    static Result<StudyContext> open(const StudyOptions& options);

    const StudyOptions& options() const { return options_; }
    const Hardware& hardware() const { return *hardware_; }
    const std::list<StudySubject>& subjects() const { return subjects_; }
    const std::vector<std::string>& absences() const { return absences_; }  // sentences
    // The model of the paper's figures, or the nearest to it: Buddha, else Dragon, else the first.
    const StudySubject& figures_subject() const;
    Page& page() { return page_; }

    // A subject's experiments on all of kPaperServers.
    std::vector<Experiment> experiments(const StudySubject& subject, const StudyModel& model,
                                        std::span<const Algorithm> algorithms, int width, int height) const;
    Results run(std::vector<Experiment> experiments, const std::string& what) const;
    // All algorithms and subjects at the paper's settings. Runs them at the first call.
    const Results& table1();

    Status write(const std::string& file, std::string_view text) const;
    // Draws STEM.svg and STEM.png, and puts the SVG on the page.
    template <class Drawing>
    Status figure(const Drawing& drawing, const std::string& stem, std::string_view caption) {
        SWATH_TRY_VOID(draw(drawing, options_.out / stem));
        page_.figure({{stem + ".svg", drawing.title}}, caption);
        return {};
    }

  private:
    explicit StudyContext(const StudyOptions& options);
    // Adds the paper's model of that name: the one given, else from models/, else the stand-in, if there is
    // one.
    Status add_paper_subject(const std::string& name, const std::string& stand_in);
    Status add_subject(const ModelName& name, bool stand_in);
    bool has_subject(const std::string& name) const;

    StudyOptions options_;
    std::list<Hardware> hardware_store_;
    const Hardware* hardware_ = nullptr;
    std::list<StudySubject> subjects_;
    std::vector<std::string> absences_;
    Page page_;
    Results table1_;
};

}  // namespace swath::sim
