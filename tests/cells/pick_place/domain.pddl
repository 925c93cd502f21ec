; A gantry carries things from the infeed over buffers to the outfeed. They arrive in one order and leave in another.
; Eyes see that a place is taken, not by what: `at` is as followed from the order of arrival on.
; That the lift goes down and comes up again within one action is nothing that a plan has to know.
(define (domain pick-place)
  (:requirements :typing :negative-preconditions :equality :numeric-fluents)
  (:types item place - object)
  (:predicates
    (over ?p - place)                      ; the gantry is there
    (full ?p - place)                      ; its eye is covered
    (clear ?p - place)                     ; its eye is not
    (holding)                              ; the gripper has something
    (free)                                 ; it has nothing
    (at ?i - item ?p - place)
    (carried ?i - item)
    (feeds ?p - place)                     ; the feeder brings things here
    (leaves ?p - place)                    ; the belt takes them away from here
    (gone ?i - item))
  (:functions
    (arrival ?i - item)                    ; its number in the order of arrival
    (arrived)                              ; so many have arrived
    (rank ?i - item)                       ; its number in the order that is wanted
    (sent)                                 ; so many have left
    (distance ?a ?b - place)               ; m
    (travel))

  (:action feed
    :parameters (?i - item ?p - place)
    :precondition (and (feeds ?p) (clear ?p) (= (arrival ?i) (+ (arrived) 1)))
    :effect (and (not (clear ?p)) (full ?p) (at ?i ?p) (increase (arrived) 1)))

  (:action move
    :parameters (?from ?to - place)
    :precondition (and (over ?from) (not (= ?from ?to)))
    :effect (and (not (over ?from)) (over ?to) (increase (travel) (distance ?from ?to))))

  (:action pick
    :parameters (?i - item ?p - place)
    :precondition (and (over ?p) (at ?i ?p) (full ?p) (free))
    :effect (and (not (at ?i ?p)) (not (full ?p)) (clear ?p) (not (free)) (holding) (carried ?i)))

  (:action place
    :parameters (?i - item ?p - place)
    :precondition (and (over ?p) (clear ?p) (carried ?i) (holding))
    :effect (and (at ?i ?p) (full ?p) (not (clear ?p)) (free) (not (holding)) (not (carried ?i))))

  (:action deliver
    :parameters (?i - item ?p - place)
    :precondition (and (leaves ?p) (full ?p) (at ?i ?p) (= (rank ?i) (+ (sent) 1)))
    :effect (and (not (full ?p)) (clear ?p) (not (at ?i ?p)) (gone ?i) (increase (sent) 1))))
