#pragma once

// Service for recipes: people read, save, remove and compare them, and load one into the running program: all
// of its values or none.
//
//   RecipeService service(tags, **store, cell, *forces, std::chrono::system_clock::now);
//   service.save("Blue 20 l", "for the small drum", {{"mixer.level", "20"}}, "ada");
//   service.load("Blue 20 l")->before;                                       // {"mixer.level": "12.5"}
//
// Threads: every function from any; load and what compares with the program block as CellControl does.
// Invariant: load writes nothing before every value has been found to be one of its tag, in its range, and
// its variable to be in the running program and not forced, by whomever. The runtime takes all values between
// the same two scans, or none.
//
// Diagnostics: those of recipe_store.h, recipe_check.h and CellControl; H0079 a tag is forced, H0080 the
// write has failed: the hint says whether nothing was written or that is not known.

#include <optional>
#include <string>
#include <vector>

#include "hmi_web/api/cell_control.h"
#include "hmi_web/api/force_service.h"
#include "hmi_web/recipes/recipe.h"
#include "hmi_web/recipes/recipe_store.h"
#include "runtime/ground/result/result.h"

namespace stepwright::api {

inline constexpr const char* kTagForced = "H0079";
inline constexpr const char* kWriteFailed = "H0080";

// For the audit trail; a recipe that was not there before has no values.
struct RecipeChange {
  recipes::Values before;
  recipes::Values after;
};

// A tag on two sides: two recipes, or a recipe and the program.
struct RecipeRow {
  std::string tag;
  std::optional<std::string> left;
  std::optional<std::string> right;
  std::string problem = {};  // why a side is missing
};

// A defined tag and its value at this moment.
struct PresentTag {
  const recipes::RecipeTag* tag = nullptr;
  result::Result<std::string> value;
};

class RecipeService {
 public:
  // References must outlive it.
  RecipeService(std::vector<recipes::RecipeTag> tags, recipes::RecipeStore& store, CellControl& cell,
                const ForceService& forces, access::WallClock clock);

  const std::vector<recipes::RecipeTag>& tags() const { return tags_; }
  std::vector<recipes::RecipeEntry> list() const { return store_.list(); }
  result::Result<recipes::Recipe> read(const std::string& name) const { return store_.read(name); }
  // Problems that keep it from being loaded, by the definitions; empty: none.
  result::Diagnostics problems_of(const recipes::Recipe& recipe) const;
  std::vector<PresentTag> present() const;
  // What the cell and the program's sources say of its tags; null: no program is known.
  std::shared_ptr<const tags::KnownTags> notes() const { return cell_.known_tags(); }

  [[nodiscard]] result::Result<std::vector<RecipeRow>> compare(const std::string& left,
                                                               const std::string& right) const;
  [[nodiscard]] result::Result<std::vector<RecipeRow>> compare_with_present(const std::string& left) const;

  [[nodiscard]] result::Result<RecipeChange> save(const std::string& name, const std::string& comment,
                                                  const recipes::Values& values, const std::string& user);
  [[nodiscard]] result::Result<RecipeChange> remove(const std::string& name);
  [[nodiscard]] result::Result<RecipeChange> load(const std::string& name);

 private:
  // With what the program that runs says of them.
  std::vector<recipes::RecipeTag> known_tags() const;
  result::Result<recipes::Values> checked_by_program(recipes::Values values) const;
  result::Result<recipes::Values> read_all(const recipes::Values& values) const;
  result::Result<void> write_all(const RecipeChange& change);

  const std::vector<recipes::RecipeTag> tags_;
  recipes::RecipeStore& store_;
  CellControl& cell_;
  const ForceService& forces_;
  const access::WallClock clock_;
};

}  // namespace stepwright::api
