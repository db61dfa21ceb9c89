// Expected values by hand from the rule: pair before species before [dem]; means of friction and restitution.
#include "core/case/contact_properties.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace polybed::core {
namespace {

Scene two_species() {
  Scene scene;
  scene.dem.youngs_modulus = 5e6;
  scene.dem.poisson_ratio = 0.25;
  scene.species.resize(2);
  set_friction(scene, 0.3);
  set_restitution(scene, 0.9);
  scene.species[0].name = "glass";
  scene.species[0].youngs_modulus = 7e6;
  scene.species[0].friction = 0.2;
  scene.species[0].restitution = 0.4;
  scene.species[1].name = "steel";
  scene.species[1].poisson_ratio = 0.33;
  return scene;
}

TEST(ContactProperties, OfSpeciesAreTheirOwnElseThoseOfDem) {
  const ContactProperties contact = contact_properties(two_species(), "glass", "steel");
  EXPECT_EQ(contact.first.youngs_modulus, 7e6);
  EXPECT_EQ(contact.first.poisson_ratio, 0.25);
  EXPECT_EQ(contact.second.youngs_modulus, 5e6);
  EXPECT_EQ(contact.second.poisson_ratio, 0.33);
  EXPECT_DOUBLE_EQ(contact.friction, 0.25);     // (0.2 + 0.3)/2
  EXPECT_DOUBLE_EQ(contact.restitution, 0.65);  // (0.4 + 0.9)/2
}

TEST(ContactProperties, OfEqualsAreTheirOwnToTheBit) {
  Scene scene = two_species();
  for (const double e : {0.1, 0.3, 0.4, 0.7, 0.95}) {
    scene.species[0].restitution = e;
    EXPECT_EQ(contact_properties(scene, "glass", "glass").restitution, e);
  }
}

TEST(ContactProperties, OfAWallAreThoseOfDem) {
  const ContactProperties contact = contact_properties(two_species(), "glass", "wall");
  EXPECT_EQ(contact.first.youngs_modulus, 7e6);
  EXPECT_EQ(contact.second.youngs_modulus, 5e6);
  EXPECT_EQ(contact.second.poisson_ratio, 0.25);
  EXPECT_DOUBLE_EQ(contact.friction, 0.25);
  EXPECT_DOUBLE_EQ(contact.restitution, 0.65);
}

TEST(ContactProperties, OfAPairGoBeforeAndHoldInEitherOrder) {
  Scene scene = two_species();
  scene.contact_pairs = {{{"steel", "glass"}, 9e6, {}, 0.8, {}}, {{"wall", "steel"}, {}, 0.1, {}, 0.5}};
  for (const bool turned : {false, true}) {
    const ContactProperties contact =
        turned ? contact_properties(scene, "steel", "glass") : contact_properties(scene, "glass", "steel");
    const ElasticProperties& glass = turned ? contact.second : contact.first;
    const ElasticProperties& steel = turned ? contact.first : contact.second;
    EXPECT_EQ(glass.youngs_modulus, 9e6);
    EXPECT_EQ(steel.youngs_modulus, 9e6);
    EXPECT_EQ(glass.poisson_ratio, 0.25);
    EXPECT_EQ(steel.poisson_ratio, 0.33);
    EXPECT_EQ(contact.friction, 0.8);
    EXPECT_DOUBLE_EQ(contact.restitution, 0.65);  // the pair leaves it open
  }
  const ContactProperties wall = contact_properties(scene, "steel", "wall");
  EXPECT_EQ(wall.first.poisson_ratio, 0.1);
  EXPECT_EQ(wall.second.poisson_ratio, 0.1);
  EXPECT_EQ(wall.second.youngs_modulus, 5e6);
  EXPECT_EQ(wall.restitution, 0.5);
  EXPECT_EQ(wall.friction, 0.3);
  EXPECT_EQ(contact_properties(scene, "steel", "steel").friction, 0.3);  // no pair of its own
}

TEST(ContactProperties, OfANameThatIsNoneAreRefused) {
  EXPECT_THROW((void)contact_properties(two_species(), "glass", "stele"), CaseError);
}

}  // namespace
}  // namespace polybed::core
