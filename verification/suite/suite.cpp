// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/suite.hpp"

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "materials/registry.hpp"
#include "solver/base/error.hpp"
#include "solver/deck/document.hpp"

namespace scree::verify {
namespace {

std::string path_of(const CaseCode& code, const char* file) {
  return "verification/cases/" + code.name + "/" + file;
}

[[noreturn]] void refuse(const Problems& problems) {
  throw std::logic_error("a verification case has mistakes:\n" + problems.text());
}

/// What is kept of one case until all of its runs are done.
struct CaseWork {
  const PlannedCase* planned = nullptr;
  CaseResult result;
  std::vector<std::unique_ptr<Run>> runs;
  std::size_t left = 0;
};

struct Job {
  std::size_t work = 0, run = 0;
};

class Runner {
 public:
  Runner(const std::vector<PlannedCase>& cases, std::shared_ptr<const DeviceToolkit> device,
         const std::function<bool()>& stop, const CaseDone& done)
      : device_(std::move(device)), stop_(stop), done_(done) {
    for (const PlannedCase& planned : cases) {
      CaseWork& work = works_.emplace_back();
      work.planned = &planned;
      work.result.name = planned.code->name;
      work.result.text = planned.text;
      work.result.sweep = planned.sweep;
      work.runs.resize(planned.sweep.runs.size());
      work.left = work.runs.size();
      for (const RunPlan& plan : planned.sweep.runs) work.result.runs.emplace_back().plan = plan;
    }
    order_jobs();
  }

  void run(int threads) {
    std::vector<std::thread> helpers;
    for (int i = 1; i < threads; ++i) helpers.emplace_back([this] { work_off(); });
    work_off();
    for (std::thread& helper : helpers) helper.join();
    if (error_) std::rethrow_exception(error_);
  }

  std::vector<CaseResult> take() {
    std::vector<CaseResult> results;
    for (CaseWork& work : works_) results.push_back(std::move(work.result));
    return results;
  }

 private:
  /// Cases that take long come first, and of a case its finest runs: the last ones are short.
  void order_jobs() {
    for (std::size_t w = 0; w < works_.size(); ++w) {
      for (std::size_t r = 0; r < works_[w].runs.size(); ++r) jobs_.push_back({w, r});
    }
    const auto seconds = [&](const Job& job) { return works_[job.work].result.sweep.seconds; };
    const auto size = [&](const Job& job) {
      return works_[job.work].result.runs[job.run].plan.size;
    };
    std::stable_sort(jobs_.begin(), jobs_.end(), [&](const Job& a, const Job& b) {
      if (a.work != b.work) return seconds(a) > seconds(b);
      return size(a) < size(b);
    });
  }

  void work_off() {
    try {
      while (true) {
        Job job;
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          if (error_ || next_ == jobs_.size()) return;
          job = jobs_[next_++];
        }
        one(works_[job.work], job.run);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }

  void one(CaseWork& work, std::size_t index) {
    RunResult& result = work.result.runs[index];
    const CaseCode& code = *work.planned->code;
    Problems problems;
    const Value deck = deck_of(work.planned->document, result.plan.parameters, problems);
    auto run = std::make_unique<Run>();
    run->parameters = result.plan.parameters;
    run->label = result.plan.label;
    run->value = result.plan.value;
    run->size = result.plan.size;
    if (problems.empty()) execute(*run, deck, path_of(code, "case.toml"), device_, problems, stop_);
    if (!problems.empty()) refuse(problems);
    if (stop_()) throw RunFault("stopped by a signal; nothing was written");
    result.deck = "# " + code.name + ": " + result.plan.label + "\n" + document_toml(deck);
    result.fault = run->fault;
    result.particles = run->particles;
    result.steps = run->steps;
    result.seconds = run->seconds;
    if (run->fault.empty()) code.measure(*run, result.measured);
    if (code.compare == nullptr) {
      run->frames.clear();
      run->history.clear();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    work.runs[index] = std::move(run);
    ++finished_;
    if (--work.left == 0) finish(work);
  }

  void finish(CaseWork& work) {
    std::vector<const Run*> runs;
    bool complete = true;
    for (const auto& run : work.runs) {
      runs.push_back(run.get());
      complete &= run->fault.empty();
    }
    const auto compare = work.planned->code->compare;
    if (compare != nullptr && complete) compare(runs, work.result.compared);
    work.runs.clear();
    judge(work.result);
    done_(work.result, finished_, static_cast<int>(jobs_.size()));
  }

  std::shared_ptr<const DeviceToolkit> device_;
  const std::function<bool()>& stop_;
  const CaseDone& done_;
  std::vector<CaseWork> works_;
  std::vector<Job> jobs_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  int finished_ = 0;
  std::exception_ptr error_;
};

}  // namespace

PlannedCase plan_case(const CaseCode& code, bool full) {
  PlannedCase planned;
  planned.code = &code;
  Problems problems;
  const auto deck = parse_document(code.deck, path_of(code, "case.toml"), problems);
  const auto expect = parse_document(code.expect, path_of(code, "expect.toml"), problems);
  if (!deck || !expect) refuse(problems);
  planned.document = *deck;
  planned.text = read_case_text(*expect, problems);
  planned.sweep = read_sweep(*deck, full, problems);
  if (problems.empty()) check_names(planned.text, planned.sweep, *expect, problems);
  if (!problems.empty()) refuse(problems);
  return planned;
}

std::string missing_law(const PlannedCase& planned) {
  for (const RunPlan& plan : planned.sweep.runs) {
    Problems ignored;
    const Value deck = deck_of(planned.document, plan.parameters, ignored);
    const Value* const materials = deck.find("material");
    if (materials == nullptr) continue;
    for (const Value& material : materials->items) {
      const Value* const model = material.find("model");
      if (model != nullptr && find_material_model(model->text) == nullptr) return model->text;
    }
  }
  return {};
}

std::string processor_only(const PlannedCase& planned) {
  for (const RunPlan& plan : planned.sweep.runs) {
    Problems ignored;
    const Value deck = deck_of(planned.document, plan.parameters, ignored);
    if (deck.find("coupling") != nullptr) return "coupling";
    const Value* const method = deck.find("method");
    const Value* const locking = method == nullptr ? nullptr : method->find("volumetric_locking");
    if (locking != nullptr && locking->text == "fbar") return "volumetric_locking";
  }
  return {};
}

std::vector<CaseResult> run_cases(const std::vector<PlannedCase>& cases, int threads,
                                  const std::shared_ptr<const DeviceToolkit>& device,
                                  const std::function<bool()>& stop, const CaseDone& done) {
  Runner runner(cases, device, stop, done);
  runner.run(threads);
  return runner.take();
}

std::string document_toml(const Value& document) {
  std::string values, tables;
  for (const Value& item : document.items) {
    if (!item.is(Value::Kind::table)) {
      values += toml_key(item.key) + " = " + to_toml(item) + "\n";
      continue;
    }
    std::string own, below;
    for (const Value& member : item.items) {
      if (member.is(Value::Kind::table) && !member.items.empty() && item.key != "method" &&
          item.key != "boundary") {
        below += "\n[" + toml_key(item.key) + "." + toml_key(member.key) + "]\n";
        for (const Value& entry : member.items)
          below += toml_key(entry.key) + " = " + to_toml(entry) + "\n";
      } else {
        own += toml_key(member.key) + " = " + to_toml(member) + "\n";
      }
    }
    if (!own.empty()) tables += "\n[" + toml_key(item.key) + "]\n" + own;
    tables += below;
  }
  return values + tables;
}

}  // namespace scree::verify
