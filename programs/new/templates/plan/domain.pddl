; What the plant can do: fill a vessel, heat what is in it, empty it into the product's tank. Litres and degrees Celsius.
(define (domain batch)
  (:requirements :typing :disjunctive-preconditions :numeric-fluents)
  (:types vessel amount - object)
  (:functions
    (level ?v - vessel)                    ; l, in the vessel
    (heel ?v - vessel)                     ; l, what stays in it
    (capacity ?v - vessel)
    (temperature ?v - vessel)              ; degC
    (cold)                                 ; degC, as it comes from the store
    (lukewarm)                             ; degC, and no warmer after a fill
    (hot)                                  ; degC, that the product needs
    (litres ?a - amount)
    (product)                              ; l, in the product's tank
    (batches))

  ; Into what is hot nothing is filled: what comes out would be lukewarm, and nobody could say how much.
  (:action fill
    :parameters (?v - vessel ?a - amount)
    :precondition (and (or (<= (level ?v) (heel ?v)) (<= (temperature ?v) (lukewarm)))
                       (<= (+ (level ?v) (litres ?a)) (capacity ?v)))
    :effect (and (increase (level ?v) (litres ?a)) (assign (temperature ?v) (cold)) (increase (batches) 1)))

  (:action heat
    :parameters (?v - vessel)
    :precondition (and (> (level ?v) (heel ?v)) (< (temperature ?v) (hot)))
    :effect (assign (temperature ?v) (hot)))

  (:action empty
    :parameters (?v - vessel)
    :precondition (and (> (level ?v) (heel ?v)) (>= (temperature ?v) (hot)))
    :effect (and (increase (product) (- (level ?v) (heel ?v))) (assign (level ?v) (heel ?v)))))
