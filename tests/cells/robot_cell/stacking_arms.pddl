; Two arms at a table that put things on regions and on each other, as goals and not as tasks. What geometry
; decides is asked elsewhere: can-move-pick, can-move-place and can-move-away in conditions, is-picked,
; is-placed and is-away in effects.
(define (domain stacking-arms)
  (:requirements :typing :negative-preconditions :equality :disjunctive-preconditions :universal-preconditions :conditional-effects)
  (:types arm grasp place - object thing - place)
  (:predicates
    (empty ?h - arm)
    (grasped ?h - arm ?o - thing)
    (in ?o - thing ?p - place)
    (up ?p - place)                     ; some hand holds it
    (near ?h - arm ?o - thing)          ; the hand is where it let go of it
    (can-move-pick ?h - arm ?g - grasp ?o - thing)
    (is-picked ?h - arm ?g - grasp ?o - thing)
    (can-move-place ?h - arm ?p - place ?o - thing)
    (is-placed ?h - arm ?p - place ?o - thing)
    (can-move-away ?h - arm ?o - thing)
    (is-away ?h - arm ?o - thing))

  (:action pick
    :parameters (?h - arm ?g - grasp ?o - thing ?p - place)
    :precondition (and (empty ?h) (in ?o ?p)
                       (forall (?x - thing) (not (in ?x ?o)))
                       (forall (?k - arm) (or (= ?k ?h) (not (near ?k ?o))))
                       (can-move-pick ?h ?g ?o))
    :effect (and (not (empty ?h)) (grasped ?h ?o) (not (in ?o ?p)) (up ?o)
                 (forall (?x - thing) (not (near ?h ?x)))
                 (is-picked ?h ?g ?o)))
  (:action place
    :parameters (?h - arm ?p - place ?o - thing)
    :precondition (and (grasped ?h ?o) (not (up ?p)) (can-move-place ?h ?p ?o))
    :effect (and (empty ?h) (not (grasped ?h ?o)) (in ?o ?p) (not (up ?o)) (near ?h ?o) (is-placed ?h ?p ?o)))
  (:action move-hand-away
    :parameters (?h - arm ?o - thing)
    :precondition (and (near ?h ?o) (can-move-away ?h ?o))
    :effect (and (not (near ?h ?o)) (is-away ?h ?o))))
